#pragma once
// What a part refuses, in the words of the one who wrote the configuration: keys, their values, what is allowed.

#include <initializer_list>
#include <string>
#include <string_view>

#include <zlg/config/config.hpp>

namespace zlg::rig {

// The message; where it names none of the keys that were set, these are added: in a rule between keys the one at fault
// may be another than the one named.
[[nodiscard]] std::string named(const config::Config& config, const std::string& message);

// errors  config::ConfigError, always: `key = value, key = value: allowed is ...`, with what `named` adds.
[[noreturn]] void refuse(const config::Config& config, std::initializer_list<std::string_view> keys,
                         std::string_view allowed);

// More than a counter of 64 bits can tell, or no number at all, shows only when the gyro runs.
[[noreturn]] void refuse_rate(const config::Config& config, std::string_view what);

// errors  config::ConfigError of fidelity `events`, in which there is no such log.
//
// log, instead  what is asked for, and what is allowed in its place.
void require_every_half(const config::Config& config, const std::string& log, const std::string& instead);

}  // namespace zlg::rig
