#pragma once
// What a sweep says, as text and as JSON.

#include <string>

#include <nlohmann/json.hpp>

#include <zlg/sweep/results.hpp>

namespace zlg::cli {

[[nodiscard]] nlohmann::json sweep_json(const sweep::Gyros& gyros, const sweep::Rows& rows);
[[nodiscard]] std::string sweep_text(const sweep::Gyros& gyros, const sweep::Rows& rows);

}  // namespace zlg::cli
