#pragma once
// The timer of a raw log with shifted bias edges.

#include <optional>
#include <string>
#include <zlg/logs/settings.hpp>

namespace zlg::logs {

// Among the settings of a CSV log, an attribute of the root of an HDF5 log.
inline constexpr const char* timer_setting = "timer_hz";

// Takes timer_hz out of the settings; `of_root` is the attribute.
//
// errors  FormatError: there is none, two that differ, no number, or one out of range; `place` begins the message.
[[nodiscard]] double take_timer_hz(Settings& settings, std::optional<double> of_root, const std::string& place);

// errors  FormatError: not within 1..1e15; `place` begins the message.
void check_timer_hz(double timer_hz, const std::string& place);

}  // namespace zlg::logs
