#pragma once
// Where the switches of a run are: found from the records alone, as compensation finds them.

#include <array>
#include <cstdint>
#include <deque>

#include <zlg/core/records.hpp>

namespace zlg::study {

// The ticks that one switch can have spoilt: its gap and the re-lock after it.
struct SwitchWindow {
    std::int64_t first_tick = 0;  // j = 1
    std::int64_t n_ticks = 0;     // of the gap; 0 while it lasts
    std::int64_t last_tick = 0;   // of the re-lock; cut short by the next gap
    int sign_after = 1;           // bias_sign * mode in the first half after the gap
    int mode_after = 1;
    double miss_lambda = 0.0;  // mean detuning of the first half with the loop closed; NaN where it is not known

    [[nodiscard]] bool gap_is_over() const { return n_ticks > 0; }
};

// One tick of the switch that is shown magnified.
struct MagnifiedTick {
    std::int64_t tick = 0;
    bool measured = true;
    double read_arcsec = 0.0;  // what the counter read
    double dtheta_arcsec = 0.0;
    double final_arcsec = 0.0;
    double true_arcsec = 0.0;
    std::array<double, 2> detuning_lambda{};       // measured, mean of each half
    std::array<double, 2> true_detuning_lambda{};  // at the end of each half
};

// Follows the records, tick by tick, and keeps the switches: gaps across which the helicity changes.
class SwitchFinder {
public:
    explicit SwitchFinder(std::int64_t relock_ticks) : relock_ticks_{relock_ticks} {}

    void take(std::int64_t tick, const core::HalfRecord& first, const core::HalfRecord& second);

    // Oldest first. One is kept until the final row of its last tick must have come.
    [[nodiscard]] const std::deque<SwitchWindow>& windows() const { return windows_; }

private:
    void begin_gap(std::int64_t tick);
    void end_gap(std::int64_t tick, const core::HalfRecord& first);

    std::int64_t relock_ticks_;
    std::deque<SwitchWindow> windows_;
    bool in_gap_ = false;
    bool was_open_ = false;  // the loop, in the half before
    bool measured_before_ = false;
    int mode_before_ = 0;
};

}  // namespace zlg::study
