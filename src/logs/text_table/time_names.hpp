#pragma once
// What the name of a column says of times.

#include <optional>
#include <string_view>

namespace zlg::logs {

// time, t, Zeit, timestamp and the like, with or without a unit behind.
[[nodiscard]] bool names_time(std::string_view column_name);

// How many of the unit in the name make a second; empty where it names none.
[[nodiscard]] std::optional<double> unit_of(std::string_view column_name);

// The name has two units that differ, as `t_ms [s]` does.
[[nodiscard]] bool names_two_units(std::string_view column_name);

}  // namespace zlg::logs
