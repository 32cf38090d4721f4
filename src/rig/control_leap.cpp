// The control after a leap.

#include <algorithm>

#include <zlg/core/common/maths.hpp>
#include <zlg/rig/leap.hpp>

namespace zlg::rig {
namespace {

// Of gyro_control.cpp and light_balance.cpp: the mean temperature by half, the ticks that are learnt from.
constexpr double temperature_weight = 1.0 / 8192.0;
constexpr double halves_a_lesson = 8.0;

// A mean that forgets by `part` a step, of what has grown evenly from `before` to `after` in n steps.
double mean_after(double mean, double before, double after, double part, double n) {
    const double lag = (after - before) / n * (1.0 - part) / part;
    const double left = core::maths::exp(n * core::maths::log(1.0 - part));
    return after - lag + (mean - before + lag) * left;
}

void pass_light(const core::MonitorLimits& limits, core::LightBalanceState& s, const Leap& leap) {
    const double lessons = static_cast<double>(leap.halves) / halves_a_lesson;
    const double before = s.weight;
    s.weight /= leap.balance_ratio;
    s.n_ticks = std::min(s.n_ticks + lessons, limits.balance_ticks);
    if (s.n_ticks > 1.0) s.slow_weight = mean_after(s.slow_weight, before, s.weight, 1.0 / s.n_ticks, lessons);
    s.level *= leap.light_ratio;
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
    s.mean_temperature_c = mean_after(s.mean_temperature_c, leap.before_c, leap.temperature_c, temperature_weight, n);
    s.temperature_c = leap.temperature_c;
    s.detector.both.level *= leap.light_ratio;
    pass_light(config.limits, s.light_balance, leap);
    pass_loop(config, s.loop, leap.set_point_v, leap.halves);
    begin_anew(s);
}

}  // namespace zlg::rig
