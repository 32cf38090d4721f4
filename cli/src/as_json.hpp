#pragma once
// What the program gives as JSON.

#include <string>

#include <nlohmann/json.hpp>

#include <zlg/config/config.hpp>

namespace zlg::cli {

// Every key that is set, dotted, with its value as a number, a string or a list.
[[nodiscard]] nlohmann::json config_json(const config::Config& config);

// Indented, with a line end. Names of files that are not UTF-8 are shown as far as they can be.
[[nodiscard]] std::string pretty(const nlohmann::json& value);

}  // namespace zlg::cli
