#pragma once
// A raw log of any length, read once, row by row, into what calibration keeps of it.

#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include <zlg/calibration/lab_log.hpp>
#include <zlg/core/records.hpp>

namespace zlg::calibration {

// Where the first window at rest begins is known when all re-locks are: 40, 80, ... 1280 ticks after them.
class LabReader {
public:
    LabReader(std::string name, double tick_s);

    // The next half-period, from half 0 on, without holes.
    void take(const core::HalfRecord& record);
    // An odd last half is dropped.
    [[nodiscard]] LabLog finish();

private:
    static constexpr std::size_t n_starts = 6;

    void take_tick(const core::HalfRecord& first, const core::HalfRecord& second);
    void begin_segment(const core::HalfRecord& first);
    void take_settled(const core::HalfRecord& first, const core::HalfRecord& second);
    void take_window(const core::HalfRecord& record);
    void end_segment();
    void choose_start();

    LabLog log_;
    bool in_segment_ = false;
    bool gap_before_ = false;
    bool has_first_ = false;
    core::HalfRecord first_;
    core::Border gap_end_;
    double last_piezo_v_ = std::numeric_limits<double>::quiet_NaN();
    std::vector<core::HalfRecord> recent_;  // the last settled window and what steered, a ring
    std::size_t oldest_ = 0;
    std::array<Moments, n_starts> start_voltage_;
    std::array<Moments, n_starts> window_variance_;
    std::vector<std::array<PiezoLevel, n_starts>> starts_;  // of each segment
};

}  // namespace zlg::calibration
