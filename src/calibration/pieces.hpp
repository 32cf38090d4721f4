#pragma once
// Blocks of all logs merged into pieces of about equal length.

#include <cstdint>
#include <span>
#include <vector>

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

}  // namespace zlg::calibration
