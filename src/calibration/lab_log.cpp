#include <zlg/calibration/lab_log.hpp>

#include <algorithm>
#include <cmath>

namespace zlg::calibration {

double slope_v_per_tick(const Segment& s) {
    constexpr double apart_ticks = static_cast<double>(window_ticks) - 0.5;
    if (!(s.at_start.n > 0 && s.at_end.middle_ticks - s.at_start.middle_ticks > apart_ticks)) return 0.0;
    return (s.at_end.voltage_v - s.at_start.voltage_v) / (s.at_end.middle_ticks - s.at_start.middle_ticks);
}

bool is_whole(const Relock& relock, double core::HalfRecord::*column) {
    return relock.halves.size() == relock_halves &&
           std::ranges::all_of(relock.halves, [&](const core::HalfRecord& r) { return std::isfinite(r.*column); });
}

void Moments::add(const Moments& other) {
    if (other.n == 0) return;
    const auto ours = static_cast<double>(n);
    const auto theirs = static_cast<double>(other.n);
    const double apart = other.mean - mean;
    sum_sq += other.sum_sq + apart * apart * ours * theirs / (ours + theirs);
    mean += apart * theirs / (ours + theirs);
    n += other.n;
}

}  // namespace zlg::calibration
