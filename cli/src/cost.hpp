#pragma once
// What work will cost, before it begins or soon after.

#include <cstdint>
#include <functional>
#include <string>

namespace zlg::cli {

struct Cost {
    std::int64_t ticks = 0;
    double bytes_a_tick = 0.0;
    std::string out;  // a file or folder on the disk that takes them; empty: where the program was called
};

// Bytes a tick of what a run writes, as runs of the paper's gyro show; other gyros differ by a few tens of percent.
inline constexpr double raw_hdf5_bytes = 107.0;
inline constexpr double raw_csv_bytes = 194.0;
inline constexpr double angles_bytes = 60.0;  // CSV and HDF5
inline constexpr double wire_bytes = 124.0;

// For a reader: "12 s", "3.4 hours".
[[nodiscard]] std::string time_text(double s);

// A warning of work that lasts over half a minute or fills a gigabyte; says nothing of less.
//
// work    does so many ticks of it, for its time to be measured.
// errors  logs::IoError where the disk cannot take two thirds of it: key, what is needed, what is free.
void announce(const Cost& cost, const std::function<void(std::int64_t ticks)>& work);

// The same of work whose cost shows only while it goes on, by a file that grows; silent where `announce` was not.
class Growth {
public:
    // part  empty: nothing is watched.
    explicit Growth(std::string part);

    // To be called now and then: what part of the work was done in which time.
    //
    // errors  logs::IoError where the disk cannot hold two thirds of the file.
    void look(double past_s, double fraction);

private:
    double expected_bytes(double fraction);

    std::string part_;
    bool is_watched_;
    double bytes_ = 0.0;
};

}  // namespace zlg::cli
