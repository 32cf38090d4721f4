#pragma once
// What a page must know of the configuration to make controls of it, as text.

#include <string>

#include <zlg/config/config.hpp>

namespace zlg::lab {

// All keys, the bits of health and the kinds of faults as one JSON object:
//
//   {"keys": [{"section", "name", "unit", "meaning", "default", "allowed", "kind", "choices"}...], "health":
//   [names...],
//    "angle_flags": [names...],
//    "faults": [{"name", "unit", "least", "most", "duration_s"}...]}
//
// kind is the name of the enumerator of config::ValueKind; least and most are those of a random fault's size,
// duration_s the middle of its durations.
[[nodiscard]] std::string schema_json();

// The keys of this configuration that differ from the defaults, a line `section.key=value` each.
[[nodiscard]] std::string changed_settings(const config::Config& config);

}  // namespace zlg::lab
