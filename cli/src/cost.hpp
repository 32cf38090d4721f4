#pragma once
// What work will cost, before it begins or soon after.

#include <cstdint>
#include <string>
#include <utility>

namespace zlg::cli {

// Bytes a tick of what a run writes, as runs of the paper's gyro show; other gyros differ by a few tens of percent.
inline constexpr double raw_hdf5_bytes = 107.0;
inline constexpr double raw_csv_bytes = 194.0;
inline constexpr double angles_bytes = 60.0;  // CSV and HDF5
inline constexpr double wire_bytes = 124.0;

// For a reader: "12 s", "3.4 hours".
[[nodiscard]] std::string time_text(double s);

// out     a file or folder on the disk that takes the run; empty: where the program was called.
// errors  logs::IoError where the disk cannot take two thirds of it: key, what is needed, what is free.
void require_room(std::int64_t ticks, double bytes_a_tick, const std::string& out);

// A second after work has begun, a warning of what lasts over five minutes or fills a gigabyte.
class Growth {
public:
    // part  the file that grows; empty: only the time is watched.
    explicit Growth(std::string part) : part_{std::move(part)} {}

    // To be called now and then: what part of the work was done in which time.
    //
    // errors  logs::IoError where the disk cannot hold two thirds of the file.
    void look(double past_s, double fraction);

private:
    double expected_bytes(double fraction);

    std::string part_;
    bool is_over_ = false;
    double bytes_ = 0.0;
};

}  // namespace zlg::cli
