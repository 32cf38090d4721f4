#pragma once
// What a log says of itself, as far as it can be understood.

#include <optional>
#include <string>
#include <string_view>

#include <zlg/config/schema.hpp>

#include "options.hpp"

namespace zlg::cli {

// What cannot be understood is damage, and dropped from a repaired copy.
struct LogSettings {
    config::Settings good;
    config::Config config;
    std::string damage;  // the first; empty: none
};

[[nodiscard]] LogSettings understood(const Options& options, const config::Settings& settings,
                                     const std::string& log_path);

// Whether a log gives this fact, with or without its section.
[[nodiscard]] bool says(const config::Settings& settings, std::string_view fact);

// D, the delay of a final value, of angles with these settings; empty where they do not say by what these were
// computed.
[[nodiscard]] std::optional<int> final_delay_ticks(const LogSettings& settings);

}  // namespace zlg::cli
