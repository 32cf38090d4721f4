#include <zlg/study/switch_window.hpp>

#include <cmath>
#include <limits>

#include <zlg/core/compensation/gap_bridge_state.hpp>

namespace zlg::study {
namespace {

// Control records 0 where it could not read the light.
bool is_read(double detuning_lambda) { return std::isfinite(detuning_lambda) && detuning_lambda != 0.0; }

}  // namespace

void SwitchFinder::begin_gap(std::int64_t tick) {
    in_gap_ = true;
    if (!windows_.empty() && windows_.back().gap_is_over() && windows_.back().last_tick >= tick)
        windows_.back().last_tick = tick - 1;
    windows_.push_back({.first_tick = tick});
}

void SwitchFinder::end_gap(std::int64_t tick, const core::HalfRecord& first) {
    in_gap_ = false;
    SwitchWindow& window = windows_.back();
    if (!measured_before_ || first.mode == mode_before_) {
        windows_.pop_back();  // frames were missed, but the helicity is the same
        return;
    }
    window.n_ticks = tick - window.first_tick;
    window.last_tick = tick - 1 + relock_ticks_;
    window.sign_after = first.bias_sign * first.mode;
    window.mode_after = first.mode;
    window.miss_lambda =
        was_open_ && is_read(first.detuning_lambda) ? first.detuning_lambda : std::numeric_limits<double>::quiet_NaN();
}

void SwitchFinder::take(std::int64_t tick, const core::HalfRecord& first, const core::HalfRecord& second) {
    while (!windows_.empty() && windows_.front().gap_is_over() &&
           windows_.front().last_tick < tick - core::history_ticks)
        windows_.pop_front();
    if (!is_measured(first, second)) {
        if (!in_gap_) begin_gap(tick);
        was_open_ = !second.loop_closed;
        return;
    }
    if (in_gap_) end_gap(tick, first);
    was_open_ = false;
    measured_before_ = true;
    mode_before_ = second.mode;
}

}  // namespace zlg::study
