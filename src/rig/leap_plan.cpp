#include <zlg/rig/leap.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <zlg/core/compensation/gap_bridge_config.hpp>
#include <zlg/rig/wiring.hpp>

namespace zlg::rig {
namespace {

constexpr std::int64_t never = std::int64_t{1} << 62;

constexpr auto balance_ticks = static_cast<std::int64_t>(core::balance_memory_ticks) * core::halves_a_lesson / 2;
constexpr std::int64_t spare_ticks = 8;  // in which a half may still be judged by those before it
constexpr double time_constants = 12.0;  // exp(-12) of a miss of .22 wavelength is below what the light shows

std::int64_t settling_ticks(const config::Config& config) {
    return static_cast<std::int64_t>(std::ceil(time_constants * config.perimeter.tau_s / config.gyro.tick_s));
}

// The light reads the converter's steps as well, and the mean square of a half has both.
twin::DetuningNoise noise_of(const config::Config& config, const core::PerimeterLoopConfig& loop) {
    if (loop.kind != core::LoopKind::digital) return {};
    const double gain = loop.half_period.value() / loop.time_constant.value();
    const double step_v = std::ldexp(config.piezo.range_max_v - config.piezo.range_min_v, -config.piezo.dac_bits);
    const double step_lambda = 0.5 * step_v / config.piezo.half_wave_v;
    const double of_steps = step_lambda * step_lambda / 12.0;
    const double of_light = config.gyro.light_noise_lambda * config.gyro.light_noise_lambda / config.gyro.light_samples;
    const double settled = (of_light + of_steps) * gain / (2.0 - gain);
    return {.sigma_lambda = std::sqrt(settled + of_steps), .kept = 1.0 - gain};
}

}  // namespace

LeapPlan leap_plan(const config::Config& config, const core::GyroControlConfig& control,
                   const core::GyroCompensationConfig& compensation, const twin::Motion& motion) {
    const core::GapBridgeConfig bridge = bridge_of(compensation);
    const bool is_estimated = core::is_estimated(bridge);
    const bool by_phase = config.gyro.readout == config::Readout::phase;
    const bool drifts_are_followed = by_phase || compensation.magnetic.method != core::MagneticMethod::none;
    const std::int64_t settles = settling_ticks(config);
    const std::int64_t corrected =
        std::max<std::int64_t>(config.compensation.relock_ticks, core::ticks_to_correction(compensation.gyro, bridge));
    const std::int64_t window = std::max(core::ticks_before_estimate, 8);
    return {.start_ticks = (by_phase ? 5 : 2) * balance_ticks,
            .after_ticks = std::max(settles, corrected) + spare_ticks,
            .before_ticks = settles + window + spare_ticks,
            .learn_ticks = is_estimated ? static_cast<std::int64_t>(core::forget_ticks) : 0,
            .all_singly = drifts_are_followed && !motion.is_even(),
            .noise = noise_of(config, control.loop)};
}

std::string why_lived(const config::Config& config, const twin::Motion& motion) {
    if (const std::string why = twin::why_no_leap(twin_config(config)); !why.empty()) return why;
    if (config.compensation.lock_in_hz != 0.0)
        return fmt::format("compensation.lock_in_hz = {}", config.compensation.lock_in_hz);
    const double bias_counts_s = std::abs(config.gyro.bias_hz);
    const double fastest_counts_s = motion.fastest_arcsec_s() / config.gyro.scale_arcsec;
    // Beyond, a half may look faulty by its counts alone.
    if (!(fastest_counts_s < 0.25 * bias_counts_s))
        return fmt::format("[motion] of up to {:.6g} arcsec/s, which is a quarter of the bias or more",
                           motion.fastest_arcsec_s());
    return {};
}

std::int64_t next_opening(const core::SwitchScheduleConfig& c, const core::SwitchScheduleState& s, std::int64_t tick,
                          std::int8_t mode) {
    if (s.waiting || s.asked) return tick;
    if (s.balanced) return never;
    // Ticks of the mode until then are those that pass.
    const std::int64_t lead = mode * s.imbalance_ticks;
    std::int64_t next = s.next_tick;
    if (c.kind != core::ScheduleKind::fixed) {
        const std::int64_t rested = s.opened_tick == 0 ? 0 : s.opened_tick + c.min_ticks - c.min_ticks / 16;
        next = std::max(tick + s.interval_ticks / 2 - (lead - mode * s.centre_ticks) - 1, rested);
    }
    if (c.end_tick > 0) next = std::min(next, tick + (c.end_tick - tick - lead) / 2 - 1);
    return std::max(next, tick);
}

bool is_quiet(const LeapPlan& plan, const core::GyroControlState& s) {
    const bool is_locked = s.mode_switch.loop_closed && s.mode_switch.phase == core::SwitchPhase::tracking;
    const bool is_light_good = !s.light_spoilt && !s.light_monitor.is_unbalanced && s.light_monitor.n_noisy == 0 &&
                               !s.light_balance.changes && s.light_balance.n_faded == 0;
    const bool is_count_good = !s.counter_stale && !s.reading_monitor.suspected && s.reading_monitor.n_since == 0 &&
                               s.counter_monitor.stuck == 0 && s.bias_monitor.n_steady == 0;
    return s.half % 2 == 0 && s.half >= 2 * plan.start_ticks && s.detuning_monitor.n_good >= 2 * plan.after_ticks &&
           s.mode_switch.n_halves >= 2 * plan.after_ticks && is_locked && is_light_good && is_count_good &&
           s.coil_monitor.n_steady == 0 && s.n_near_end == 0 && s.order.known && s.commutator.timer_known;
}

}  // namespace zlg::rig
