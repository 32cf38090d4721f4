#include <zlg/trials/magnetic_gate.hpp>

#include <cmath>

#include <zlg/core/common/maths.hpp>

namespace zlg::trials {
namespace {

using namespace zlg::core;

constexpr double tick_s = 0.005;
constexpr int gap_ticks = 3;
constexpr double walk_arcsec_sqrt_s = 0.14;

std::int64_t ticks_of(double time_s) { return std::llround(time_s / tick_s); }

SwitchScheduleConfig schedule_of(const MagneticGate& gate) {
    return {.interval_ticks = ticks_of(gate.interval_s),
            .first_segment = gate.first_segment,
            .kind = gate.schedule,
            .min_ticks = ticks_of(gate.interval_s),
            .max_ticks = ticks_of(std::fmax(gate.longest_s, gate.interval_s)),
            .tick_s = tick_s};
}

}  // namespace

GateResult gate_result(const MagneticGate& gate, const MovingBase& base, std::uint64_t seed) {
    const BaseRate rate = base.make({seed, chance::Cause::magnetic_base}, seed);
    chance::Draw walk{seed, chance::Cause::magnetic_walk};
    const CompensationConstants constants;
    MagneticDriftState state;
    const SwitchScheduleConfig schedule = schedule_of(gate);
    SwitchScheduleState switches = initial_state(schedule);
    const double judged_s = 2.0 * std::fmax(gate.longest_s, gate.interval_s);
    const std::int64_t end =
        ticks_of(gate.run_s + judged_s * chance::Draw{seed, chance::Cause::magnetic_end}.uniform());
    const std::int64_t judged = end - ticks_of(judged_s);
    double magnetic = 0.0, residual = 0.0, angle = 0.0, read = 0.0, drift = 0.0, without_sq = 0.0, with_sq = 0.0;
    std::int64_t n = 0;
    std::int8_t mode = 1;
    int gap = 0;
    for (std::int64_t k = 0; k < end; ++k) {
        const double left = remaining_arcsec_s(gate.estimator, state);
        if (k > 0 && step(schedule, switches, {.tick = k, .mode = mode, .advice = {0.0, left}})) {
            mode = static_cast<std::int8_t>(-mode);
            gap = gap_ticks;
        }
        const double t_s = static_cast<double>(k) * tick_s;
        const bool measured = gap == 0;
        if (gap > 0) --gap;
        drift = 0.7 + 0.7 * -maths::expm1(-t_s / 3000.0);
        const double turned = mode * drift * tick_s;
        angle += rate(t_s, mode) * tick_s + turned + walk_arcsec_sqrt_s * std::sqrt(tick_s) * walk.normal();
        const double now = gate.count_arcsec * std::floor(angle / gate.count_arcsec);
        const double subtracted = step(constants, gate.estimator, state, {measured, mode, now - read});
        read = now;
        if (measured) magnetic += turned;
        if (measured) residual += turned;
        residual -= subtracted;
        if (k < judged || k % 200 != 0) continue;
        without_sq += magnetic * magnetic;
        with_sq += residual * residual;
        ++n;
    }
    const auto count = static_cast<double>(n);
    return {.without_arcsec = std::sqrt(without_sq / count),
            .with_arcsec = std::sqrt(with_sq / count),
            .error_arcsec_s = std::abs(state.estimate[of_drift] - drift),
            .trust = state.trust};
}

}  // namespace zlg::trials
