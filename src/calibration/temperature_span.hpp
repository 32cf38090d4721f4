#pragma once
// Whether the logs cover enough temperature for a law.

#include <algorithm>
#include <span>
#include <string>

#include <fmt/format.h>

#include <zlg/calibration/lab_log.hpp>

namespace zlg::calibration {

inline constexpr double min_span_c = 1.0;

inline bool has_temperature(std::span<const LabLog> logs) {
    return !logs.empty() && std::all_of(logs.begin(), logs.end(), [](const LabLog& l) { return l.has_temperature(); });
}

// Empty where they do; else why not.
inline std::string too_few_temperatures(std::span<const LabLog> logs) {
    if (!has_temperature(logs)) return "a log has no settled halves with the column temperature_c";
    LabLog all;
    for (const LabLog& log : logs) {
        all.temperature_min_c = std::min(all.temperature_min_c, log.temperature_min_c);
        all.temperature_max_c = std::max(all.temperature_max_c, log.temperature_max_c);
    }
    const double span_c = all.temperature_max_c - all.temperature_min_c;
    if (span_c >= min_span_c) return {};
    return fmt::format("the temperature spans {:.2g} C; {} C or more determine a law", span_c, min_span_c);
}

}  // namespace zlg::calibration
