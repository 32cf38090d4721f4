#pragma once
// A temperature column in the unit that its name has: degrees Celsius, kelvin, degrees Fahrenheit.

#include <string>
#include <zlg/logs/text_columns.hpp>

namespace zlg::logs {

// Its values become degrees Celsius; what was done, in words, and empty where the name has no other unit.
[[nodiscard]] std::string make_celsius(TextColumn& column);

}  // namespace zlg::logs
