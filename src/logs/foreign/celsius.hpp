#pragma once
// A temperature column in the unit that its name has: degrees Celsius, kelvin, degrees Fahrenheit.

#include <string>
#include <zlg/logs/text_columns.hpp>

namespace zlg::logs {

// Its values become degrees Celsius; what was done or presumed, in words, and empty where its name says C.
//
// errors  MappingError: its name has a factor or a unit of something else.
[[nodiscard]] std::string make_celsius(TextColumn& column);

}  // namespace zlg::logs
