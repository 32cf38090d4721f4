#pragma once
// What the name of a column says of times.

#include <optional>
#include <string>
#include <string_view>

namespace zlg::logs {

// time, t, Zeit, timestamp and the like, with or without a unit behind, in whatever group or message.
[[nodiscard]] bool names_time(std::string_view column_name);

// One of its words is of times: Shimmer_Timestamp_Unix, SampleTimeFine, GPS TOW.
[[nodiscard]] bool mentions_time(std::string_view column_name);

// One of its words is of something said of a rate, and no rate: sigma_dps, gyro_bias_dps, range_dps.
[[nodiscard]] bool names_statistic(std::string_view column_name);

// One of its words is of a number of rows: seq, PacketCounter, loopIteration.
[[nodiscard]] bool names_counter(std::string_view column_name);

// How many make a second, of a word in small letters; empty: it is no unit of times.
[[nodiscard]] std::optional<double> time_unit(std::string_view word);

// s^-1 and s-1 as /s.
[[nodiscard]] std::string without_powers(std::string_view name);

// A number or an operator beside a unit, as in `t [10us]`, `w*100 [deg/s]`, `w_x1000_dps`: what the unit then is nobody
// knows. The number of an axis or a sensor, as in gyro1_z or gyro_1_dps, is none.
[[nodiscard]] bool names_factor(std::string_view name);

// How many of the unit in the name make a second; empty where it names none, or has a factor beside it.
[[nodiscard]] std::optional<double> unit_of(std::string_view column_name);

// The name has two units that differ, as `t_ms [s]` does.
[[nodiscard]] bool names_two_units(std::string_view column_name);

}  // namespace zlg::logs
