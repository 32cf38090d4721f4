#pragma once
// What work will cost, before it begins.

#include <cstdint>
#include <string>

namespace zlg::cli {

// Bytes a tick of what a run writes, as runs of the paper's gyro show; other gyros differ by a few tens of percent.
inline constexpr double angles_bytes = 60.0;  // CSV and HDF5
[[nodiscard]] constexpr double raw_bytes(bool is_csv, int light_samples) {
    return (is_csv ? 194.0 : 107.0) + 2.0 * 2.0 * sizeof(float) * light_samples;  // in both halves, of both beams
}
inline constexpr double wire_bytes = 124.0;

// For a reader: "12 s", "3.4 hours".
[[nodiscard]] std::string time_text(double s);

// out     a file or folder on the disk that takes the run; empty: where the program was called.
// errors  logs::IoError where the disk cannot take two thirds of it: key, what is needed, what is free.
void require_room(std::int64_t ticks, double bytes_a_tick, const std::string& out);

}  // namespace zlg::cli
