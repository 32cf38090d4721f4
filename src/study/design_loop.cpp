#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <zlg/design/error.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/wiring.hpp>

#include "design_parts.hpp"

namespace zlg::study {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double relock_tolerance_lambda = 0.01;
constexpr int relock_ticks_shown = 8;
constexpr int relock_ticks_at_most = 4000;
constexpr int relock_ticks_at_least = 40;

bool is_digital(const config::Config& config) { return config.perimeter.loop == config::Loop::digital; }
bool is_exponential(const config::Config& config) { return config.perimeter.loop == config::Loop::exponential; }

// The digital loop acts once a half on the mean of the half before: delay T/4 by the mean, T/4 by holding. It cannot be
// faster than one half.
design::PerimeterLoop perimeter_loop(const config::Config& config) {
    const double half_s = 0.5 * config.gyro.tick_s;
    return {.tau_s = is_digital(config) ? std::max(config.perimeter.tau_s, half_s) : config.perimeter.tau_s,
            .delay_s = is_digital(config) ? half_s : 0.0,
            .rc_s = is_exponential(config) ? 0.0 : config.piezo.rc_s};
}

design::RelockLoop relock_loop(const config::Config& config) {
    const double lambda_per_v = 0.5 / config.piezo.half_wave_v;
    return {.tick_s = config.gyro.tick_s,
            .tau_s = config.perimeter.tau_s,
            .limit_lambda = is_exponential(config) ? design::RelockLoop::none : config.perimeter.limit_lambda,
            .rc_s = is_exponential(config) ? 0.0 : config.piezo.rc_s,
            .slew_lambda_s = is_exponential(config) ? design::RelockLoop::none : config.piezo.slew_v_s * lambda_per_v};
}

design::MissCauses miss_causes(const config::Config& config) {
    design::MissCauses causes{.half_wave_v = config.piezo.half_wave_v,
                              .half_wave_error_ratio = std::abs(config.piezo.half_wave_error),
                              .range_v = config.piezo.range_max_v - config.piezo.range_min_v,
                              .dac_bits = static_cast<int>(config.piezo.dac_bits)};
    causes.hysteresis_stroke_v = std::max(causes.hysteresis_stroke_v, causes.half_wave_v);
    causes.dwell_s = std::max(config.switching.interval_s, causes.settling_s);
    return causes;
}

// Detuning from which the loop re-locks: where none is configured, the one that its causes make together.
double presumed_miss_lambda(const config::Config& config) {
    const double miss = config.perimeter.miss_lambda;
    return miss > 0.0 ? miss : design::initial_miss(miss_causes(config)).root_sum_square_lambda;
}

// A re-lock from a miss, with the bias law of the gyro.
struct Relock {
    double from_lambda = unknown;
    std::vector<double> false_drift_arcsec_s;  // per tick
    std::vector<double> mean_square_lambda2;   // per half
    double time_s = unknown;                   // infinite: not within what was simulated,
    int ticks = 0;                             // which is so long
};

design::BiasLaw bias_law(const config::Gyro& gyro) {
    return {.scale_arcsec = gyro.scale_arcsec, .bias_hz = gyro.bias_hz, .chi = gyro.bias_chi};
}

// Long enough for the limiter to bring the miss down and for the rest to decay.
int ticks_needed(const config::Config& config) {
    const double time_constants = 20.0 + 2.0 * presumed_miss_lambda(config) / config.perimeter.limit_lambda;
    const double ticks = time_constants * config.perimeter.tau_s / config.gyro.tick_s;
    return static_cast<int>(std::clamp<double>(ticks, relock_ticks_at_least, relock_ticks_at_most));
}

// A loop with time constants that are far below a tick is shown for as long as a few seconds of computation go.
int ticks_affordable(const design::RelockLoop& loop, int ticks) {
    constexpr double max_steps = 2e7;
    while (ticks > relock_ticks_at_least && design::relock_steps(loop, ticks) > max_steps)
        ticks = std::max(ticks / 2, relock_ticks_at_least);
    return ticks;
}

Relock relock_of_electronics(const config::Config& config, const design::RelockLoop& loop) {
    const double miss = presumed_miss_lambda(config);
    const int ticks = ticks_affordable(loop, ticks_needed(config));
    const auto trace = design::simulate_relock(loop, miss, ticks);
    Relock relock{.from_lambda = miss, .ticks = ticks};
    relock.false_drift_arcsec_s = design::false_drift_arcsec_s(bias_law(config.gyro), trace, -1);
    for (const design::HalfDetuning& half : trace.half) relock.mean_square_lambda2.push_back(half.mean_square_lambda2);
    relock.time_s = design::relock_time_s(trace, relock_tolerance_lambda);
    return relock;
}

// A gyro at rest without noise and drift, that switches once.
config::Config quiet(config::Config config, int ticks) {
    config.motion.kind = config::MotionKind::rest;
    config.drift = {.magnetic_arcsec_s = 0.0,
                    .magnetic_thermal_arcsec_s = 0.0,
                    .nonmagnetic_arcsec_s = 0.0,
                    .random_walk_arcsec_sqrt_s = 0.0};
    config.gyro.temperature_rise_c = 0.0;
    config.gyro.light_noise_lambda = 0.0;
    config.piezo.adc_noise_v = 0.0;
    config.faults = {};
    config.switching.schedule = config::Schedule::fixed;
    config.switching.interval_optimal = false;
    config.switching.first_segment = config::FirstSegment::full;
    config.switching.interval_s =
        config.gyro.tick_s * (ticks + static_cast<double>(config.switching.gap_ticks) + 100.0);
    return config;
}

// The processor's own loop is not modelled again: it runs, on the twin.
Relock relock_on_twin(const config::Config& config) {
    const int ticks = ticks_needed(config);
    const config::Config still = quiet(config, ticks);
    rig::ClosedLoop loop{still, twin::Motion::rest()};
    const auto max_halves = static_cast<std::int64_t>(4.0 * still.switching.interval_s / config.gyro.tick_s);
    std::int64_t halves = 0;
    const auto advance = [&] {
        if (++halves > max_halves)
            throw design::DesignError{fmt::format(
                "perimeter.loop = \"digital\": on the twin no switch comes to an end within {} ticks; zlg run "
                "shows what it does",
                max_halves / 2)};
        return loop.advance();
    };
    while (advance().record.loop_closed) {
    }
    Relock relock{.ticks = ticks};
    rig::LoopHalf half = advance();
    for (; !half.record.loop_closed; half = advance()) relock.from_lambda = std::abs(half.truth.detuning_end_lambda);
    // The twin puts a configured miss in place at the moment of closing.
    if (config.perimeter.miss_lambda > 0.0) relock.from_lambda = config.perimeter.miss_lambda;
    double last_outside_s = 0.0;
    for (int k = 0; k < ticks; ++k) {
        double false_arcsec = 0.0;
        const int sign = half.record.bias_sign * half.record.mode;
        for (int h = 0; h < 2; ++h, half = loop.advance()) {
            const double end = half.truth.detuning_end_lambda;
            false_arcsec += half.truth.false_relock_arcsec;
            relock.mean_square_lambda2.push_back(half.record.detuning_sq_lambda2);
            if (std::abs(end) > relock_tolerance_lambda) last_outside_s = (k + 0.5 * (h + 1)) * config.gyro.tick_s;
        }
        relock.false_drift_arcsec_s.push_back(-sign * false_arcsec / config.gyro.tick_s);
    }
    // Known to half a tick: the next half is within the tolerance.
    relock.time_s = last_outside_s + 0.5 * config.gyro.tick_s;
    return relock;
}

Relock relock_of(const config::Config& config) {
    return is_digital(config) ? relock_on_twin(config) : relock_of_electronics(config, relock_loop(config));
}

void add_relock(const config::Config& config, LoopLine& line) {
    const Relock relock = relock_of(config);
    line.false_angle_law_arcsec = design::false_angle_law_arcsec(
        design::bias_deficit_arcsec_s(bias_law(config.gyro), relock.from_lambda), config.gyro.tick_s);
    line.false_drift_arcsec_s.assign(relock.false_drift_arcsec_s.begin(),
                                     relock.false_drift_arcsec_s.begin() + relock_ticks_shown);
    line.relock_from_lambda = relock.from_lambda;
    line.relock_s = relock.time_s;
    for (double rate : relock.false_drift_arcsec_s) line.false_angle_arcsec += rate * config.gyro.tick_s;
    if (std::isfinite(line.relock_s)) return;
    line.false_angle_arcsec = unknown;
    line.relock_note = fmt::format("not within {} ticks, where the simulation ends", relock.ticks);
}

}  // namespace

RelockResidual relock_residual(const config::Config& config) {
    const Relock relock = relock_of(config);
    const bool corrected = config.compensation.relock != core::RelockMethod::none;
    const auto n = std::min<std::size_t>(static_cast<std::size_t>(config.compensation.relock_ticks),
                                         relock.false_drift_arcsec_s.size());
    RelockResidual residual{.random = corrected, .tick_arcsec = {}};
    const double s2 = config.gyro.light_noise_lambda * config.gyro.light_noise_lambda;
    const double arcsec_per_lambda2 =
        0.5 * config.gyro.bias_chi * config.gyro.bias_hz * config.gyro.scale_arcsec * config.gyro.tick_s;
    for (std::size_t k = 0; k < (corrected ? n : relock.false_drift_arcsec_s.size()); ++k) {
        const double squares = relock.mean_square_lambda2[2 * k] + relock.mean_square_lambda2[2 * k + 1];
        const double variance = (4.0 * squares * s2 + 4.0 * s2 * s2) / static_cast<double>(config.gyro.light_samples);
        residual.tick_arcsec.push_back(corrected ? arcsec_per_lambda2 * std::sqrt(variance)
                                                 : relock.false_drift_arcsec_s[k] * config.gyro.tick_s);
    }
    return residual;
}

LoopLine loop_line(const config::Config& config) {
    LoopLine line;
    line.loop = perimeter_loop(config);
    line.margins = design::margins(line.loop);
    line.tick_over_tau = config.gyro.tick_s / line.loop.tau_s;
    // Samples per tick: two of the digital loop, without delay beyond the mean; else one, that acts a tick later.
    line.stability_limit =
        is_digital(config) ? 2.0 * design::sampled_stability_limit(0) : design::sampled_stability_limit(1);
    line.stability_note = is_digital(config) ? "two samples a tick and a stage that follows at once"
                                             : "a detector sampled once a tick that acts one tick later";
    line.miss = design::initial_miss(miss_causes(config));
    add_relock(config, line);
    return line;
}

}  // namespace zlg::study
