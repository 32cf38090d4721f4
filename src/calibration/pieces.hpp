#pragma once
// Blocks of all logs merged into pieces of about equal length.

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <zlg/calibration/lab_log.hpp>

namespace zlg::calibration {

struct Piece {
    std::int64_t chain = 0;  // of one segment of one log
    std::size_t log = 0;
    std::int8_t mode = 1;
    double start_s = 0.0;  // since the first half of its log
    double length_s = 0.0;
    double counts = 0.0;
    double difference = 0.0;
    double temperature_c = 0.0;  // mean
    double signed_rise_c = 0.0;  // of the temperature, with the sign of the bias in the first half of each tick
};

// min_s  a piece goes on until it is so long or its segment ends.
[[nodiscard]] std::vector<Piece> pieces_of(std::span<const LabLog> logs, double min_s);

// Length of the settled record.
[[nodiscard]] double settled_s(std::span<const LabLog> logs);

// Whether the logs cover enough temperature for a law.
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
