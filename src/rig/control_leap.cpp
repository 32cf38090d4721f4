// The control after a leap.

#include <algorithm>
#include <array>
#include <cstdint>

#include <zlg/core/common/maths.hpp>
#include <zlg/rig/leap.hpp>

namespace zlg::rig {
namespace {

// A mean that forgets by `part` a step, of what has grown evenly from `before` to `after` in n steps.
double mean_after(double mean, double before, double after, double part, double n) {
    const double lag = (after - before) / n * (1.0 - part) / part;
    const double left = core::maths::exp(n * core::maths::log(1.0 - part));
    return after - lag + (mean - before + lag) * left;
}

// (x, z) <- M^n (x, z) of light_balance.hpp's filter, by squaring M. From lesson to lesson, where ln w is x above what
// would balance the beams, and both grow apart by z,
//
//   x' = (1 - 1/100 - g) x + z,   z' = z - g x
void pass_lessons(std::int64_t n, double& x, double& z) {
    constexpr double g = core::balance_drift_gain;
    double xx = 1.0 - 1.0 / core::balance_memory_ticks - g, xz = 1.0, zx = -g, zz = 1.0;
    for (; n > 0; n /= 2) {
        if (n % 2 != 0) {
            const double passed = xx * x + xz * z;
            z = zx * x + zz * z;
            x = passed;
        }
        const double turned = xz * zx, trace = xx + zz;
        xx = xx * xx + turned;
        zz = zz * zz + turned;
        xz *= trace;
        zx *= trace;
    }
}

// The light changes evenly, and its noise, a hundredth of that of a half in w, is left out.
void pass_light(const core::MonitorLimits& limits, core::LightBalanceState& s, const Leap& leap) {
    const std::int64_t n = leap.halves / core::halves_a_lesson;
    const auto lessons = static_cast<double>(n);
    if (n == 0) return;
    const auto balanced = [&](const std::array<double, 2>& light) { return light[0] / (light[1] - s.offset); };
    const double before = s.weight, from = balanced(leap.light_before), to = balanced(leap.light_after);
    const double growth = core::maths::log(from / to) / lessons;
    double x = core::maths::log(before / from), z = 2.0 * s.drift + growth;
    pass_lessons(n, x, z);
    s.weight = to * core::maths::exp(x);
    s.drift = 0.5 * (z - growth);
    s.n_ticks = std::min(s.n_ticks + lessons, limits.balance_ticks);
    if (s.n_ticks > 1.0) s.slow_weight = mean_after(s.slow_weight, before, s.weight, 1.0 / s.n_ticks, lessons);
    s.level *= leap.light_after[0] / leap.light_before[0];
}

// What is compared with the half before begins anew: the motion goes on elsewhere.
void begin_anew(core::GyroControlState& s) {
    s.bias_monitor.n_known = 0;
    s.counter_monitor.n_known = 0;
    s.light_monitor.has_last = s.light_monitor.has_end = false;
}

void pass_loop(const core::GyroControlConfig& c, core::PerimeterLoopState& s, double change_v, std::int64_t halves) {
    s.n_closed = static_cast<std::int32_t>(std::min<std::int64_t>(s.n_closed + halves, 1 << 30));
    if (c.loop.kind != core::LoopKind::digital) return;
    for (double* v : {&s.set_point_v, &s.mean_v, &s.end_v, &s.start_v}) *v += change_v;
}

}  // namespace

void leap(const core::GyroControlConfig& config, core::GyroControlState& s, const Leap& leap) {
    const auto n = static_cast<double>(leap.halves);
    s.half += leap.halves;
    s.order.expected += static_cast<std::uint32_t>(leap.halves);
    s.order.last += static_cast<std::uint32_t>(leap.halves);
    s.commutator.expected_ticks += static_cast<std::uint64_t>(leap.halves) * config.commutator.half_ticks;
    s.schedule.imbalance_ticks += leap.mode * leap.ticks();
    s.mode_switch.n_halves =
        static_cast<std::int32_t>(std::min<std::int64_t>(s.mode_switch.n_halves + leap.halves, 1 << 30));
    for (std::uint64_t* reading : {&s.counter, &s.reading_monitor.good, &s.reading_monitor.last})
        *reading += static_cast<std::uint64_t>(leap.counts);
    s.bias_monitor.bias_counts *= leap.bias_ratio;
    s.mean_temperature_c =
        mean_after(s.mean_temperature_c, leap.before_c, leap.temperature_c, core::temperature_weight, n);
    s.temperature_c = leap.temperature_c;
    s.detector.both.level *= leap.light_after[0] / leap.light_before[0];
    pass_light(config.limits, s.light_balance, leap);
    pass_loop(config, s.loop, leap.set_point_v, leap.halves);
    begin_anew(s);
}

}  // namespace zlg::rig
