#pragma once
// The table of switches: of a gyro that runs, and of a recorded log.
//
// All but the half-wave voltage (half_wave_replay.hpp) and the true error follows from the records and from what
// compensation makes of them.

#include <cstdint>
#include <deque>
#include <limits>
#include <map>
#include <vector>

#include <zlg/core/records.hpp>
#include <zlg/study/switch_window.hpp>

namespace zlg::study {

// One line. NaN: not known.
struct SwitchLine {
    std::int64_t tick = 0;     // first of the gap
    int mode = 1;              // after the switch
    double miss_lambda = 0.0;  // mean detuning of the first half with the loop closed
    double half_wave_v = std::numeric_limits<double>::quiet_NaN();  // estimate of the control after this switch
    double half_wave_sigma_v = std::numeric_limits<double>::infinity();
    std::int64_t gap_ticks = 0;
    double dp_arcsec = 0.0;      // eq (16)
    double relock_arcsec = 0.0;  // false angle subtracted; NaN where the records end before the re-lock does
    double sigma_arcsec = 0.0;   // of the angle of the whole switch, gap and re-lock
    double true_error_arcsec = std::numeric_limits<double>::quiet_NaN();  // of a twin; NaN as relock_arcsec
};

class SwitchTable {
public:
    explicit SwitchTable(std::int64_t relock_ticks) : finder_{relock_ticks} {}

    // A tick's halves.
    void take(std::int64_t tick, const core::HalfRecord& first, const core::HalfRecord& second);

    // What compensation says, in its order.
    void take(const core::AngleRow& row);
    void take(const core::GapReport& gap) {
        if (gap.mode_changed) gaps_[gap.first_tick] = gap;
    }

    // Those of which some final row may still come, oldest first.
    [[nodiscard]] const std::deque<SwitchWindow>& windows() const { return finder_.windows(); }

    // A switch is listed once its gap is over.
    [[nodiscard]] std::vector<SwitchLine> lines() const;

private:
    SwitchFinder finder_;
    std::map<std::int64_t, SwitchWindow> switches_;  // the maps by the first tick of the gap
    std::map<std::int64_t, core::GapReport> gaps_;
    std::map<std::int64_t, double> relock_arcsec_;
    double relock_so_far_arcsec_ = 0.0;
};

}  // namespace zlg::study
