#pragma once
// What a log says of itself, as far as it can be understood.

#include <string>

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

}  // namespace zlg::cli
