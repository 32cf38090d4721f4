#include "bias_wiring.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include <zlg/config/schema.hpp>
#include <zlg/rig/wiring.hpp>

#include "fault_wiring.hpp"
#include "laser_wiring.hpp"

namespace zlg::rig {
namespace {

using config::ConfigError;

// Counts of a half at which a counter that follows no faster would stop.
std::int64_t counts_limit(const config::Config& config) {
    const double most = 0.5 * config.gyro.tick_s * counter_max_hz(config.gyro);
    return static_cast<std::int64_t>(std::clamp(most - 1.0, 1.0, 0x1p62));
}

}  // namespace

double plateau_ratio(const config::Gyro& g) { return 1.0 / (1.0 - std::min(g.bias_edge_s / g.tick_s, 0.5)); }

core::BiasCommutatorConfig commutator_of(const config::Config& config) {
    const config::Gyro& g = config.gyro;
    core::BiasCommutatorConfig made{.half_ticks = static_cast<std::uint64_t>(std::llround(0.5 * g.tick_s * timer_hz))};
    made.tolerance_ticks = std::min(made.tolerance_ticks, made.half_ticks - 1);
    // A latch that is late by a count's time of the bias.
    made.latch_ticks = static_cast<std::uint64_t>(std::clamp(timer_hz / g.bias_hz, 10.0, 1e6));
    if (g.dither == core::DitherMethod::none) return made;
    made.dither = {.method = g.dither,
                   .seed = static_cast<std::uint64_t>(config.run.seed),
                   .half_ticks = made.half_ticks,
                   .cycle_ticks = counts_per_fringe(config) * timer_hz / (plateau_ratio(g) * g.bias_hz),
                   .tick_s = g.tick_s,
                   .scale_arcsec = g.scale_arcsec};
    if (check(made.dither) == core::EdgeDitherFault::cycle_ticks)
        throw ConfigError{
            fmt::format("gyro.dither: a cycle of gyro.bias_hz = {} is {} ticks of the timer of {} Hz; allowed is "
                        "1..{}, an eighth of a "
                        "half",
                        g.bias_hz, made.dither.cycle_ticks, timer_hz, static_cast<double>(made.half_ticks) / 8.0)};
    // A shift must leave each half its plateau.
    const double most_ticks = 0.5 * (0.5 * g.tick_s - g.bias_edge_s) * timer_hz;
    if (1.01 * made.dither.cycle_ticks > most_ticks)
        throw ConfigError{fmt::format(
            "gyro.dither: shifts reversals by up to {} ticks of the timer, a cycle of gyro.bias_hz = {}; "
            "gyro.bias_edge_s = {} and gyro.tick_s = {} allow {}",
            std::ceil(1.01 * made.dither.cycle_ticks), g.bias_hz, g.bias_edge_s, g.tick_s, std::floor(most_ticks))};
    return made;
}

void add_monitors(const config::Config& config, core::GyroControlConfig& made) {
    const config::Gyro& g = config.gyro;
    const double bias_counts = 0.5 * g.tick_s * g.bias_hz;
    made.health.counts_limit = counts_limit(config);
    made.bias_monitor.presumed_counts = std::min(bias_counts, 1e15);
    if (bias_counts >= core::least_bias_counts) made.coil_monitor.tolerance_ratio = 0.5 / bias_counts;
    made.counter_monitor.watches = true;
    made.light_monitor.noise = core::Wavelengths{std::min(g.light_noise_lambda, 10.0)};
    // A laser whose curve is not known reads several times its detuning: the bias cannot have lost what that would take.
    const bool reads_true = g.fidelity != config::Fidelity::laser || made.detector.curve.n_nodes > 0;
    if (!reads_true) made.light_monitor.most_gain = 10.0;
    if (reads_true && g.bias_chi > 0.0 && bias_counts >= 100.0) made.light_monitor.bias_chi = std::min(g.bias_chi, 1e6);
    const double false_counts = bias_counts * g.bias_chi;
    if (false_counts > 0.0) {
        const double noise_lambda2 = g.light_noise_lambda * g.light_noise_lambda;
        made.detuning_monitor.most_change_lambda2 = std::min(1.0 / false_counts + 20.0 * noise_lambda2, 1e6);
    }
    made.detuning_monitor.relock_ticks = static_cast<std::int32_t>(config.compensation.relock_ticks);
}

}  // namespace zlg::rig
