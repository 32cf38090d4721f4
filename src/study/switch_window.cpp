#include <zlg/study/switch_window.hpp>

namespace zlg::study {

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
}

void SwitchFinder::take(std::int64_t tick, const core::HalfRecord& first, const core::HalfRecord& second) {
    if (!is_measured(first, second)) {
        if (!in_gap_) begin_gap(tick);
        return;
    }
    if (in_gap_) end_gap(tick, first);
    measured_before_ = true;
    mode_before_ = second.mode;
}

}  // namespace zlg::study
