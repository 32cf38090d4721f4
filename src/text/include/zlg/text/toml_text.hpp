#pragma once
// Values as TOML text.

#include <string>
#include <string_view>

namespace zlg::text {

// The shortest form that reads back to the same number; a whole number may come without a point.
[[nodiscard]] std::string toml_real(double value);

// Quoted, on one line whatever it holds.
[[nodiscard]] std::string toml_string(std::string_view text);

}  // namespace zlg::text
