#include "bias_wiring.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include <zlg/config/schema.hpp>
#include <zlg/twin/twin_config.hpp>

namespace zlg::rig {

using twin::timer_hz;

double plateau_ratio(const config::Gyro& g) { return 1.0 / (1.0 - std::min(g.bias_edge_s / g.tick_s, 0.5)); }

double counter_max_hz(const config::Gyro& gyro) {
    constexpr double highest_arcsec_s = 400.0 * 3600.0;
    constexpr double room = 1.01;  // the bias may be greater than it is presumed
    const double plateau_hz = plateau_ratio(gyro) * gyro.bias_hz;
    return gyro.counter_max_hz.value_or(room * (plateau_hz + highest_arcsec_s / gyro.scale_arcsec));
}

core::BiasCommutatorConfig commutator_of(const config::Config& config) {
    const config::Gyro& g = config.gyro;
    core::BiasCommutatorConfig made{.half_ticks = static_cast<std::uint64_t>(std::llround(0.5 * g.tick_s * timer_hz))};
    made.tolerance_ticks = std::min(made.tolerance_ticks, made.half_ticks - 1);
    // A latch that is late by a count's time of the bias.
    made.latch_ticks = static_cast<std::uint64_t>(std::clamp(timer_hz / g.bias_hz, 10.0, 1e6));
    if (g.dither == core::DitherMethod::none) return made;
    made.dither = {.method = g.dither,
                   .seed = config.run.seed,
                   .cycle_ticks = counts_per_turn(config.laser.quadrature) * timer_hz / (plateau_ratio(g) * g.bias_hz),
                   .tick_s = g.tick_s,
                   .scale_arcsec = g.scale_arcsec};
    if (made.half_ticks >= 8 && !has_cycle(made))
        throw config::ConfigError{
            fmt::format("gyro.dither: a cycle of gyro.bias_hz = {} is {} ticks of the timer of {} Hz; allowed is "
                        "1..{}, an eighth of a half",
                        g.bias_hz, made.dither.cycle_ticks, timer_hz, static_cast<double>(made.half_ticks) / 8.0)};
    // A shift must leave each half its plateau.
    const double max_ticks = 0.5 * (0.5 * g.tick_s - g.bias_edge_s) * timer_hz;
    if (1.01 * made.dither.cycle_ticks > max_ticks)
        throw config::ConfigError{fmt::format(
            "gyro.dither: shifts reversals by up to {} ticks of the timer, a cycle of gyro.bias_hz = {}; "
            "gyro.bias_edge_s = {} and gyro.tick_s = {} allow {}",
            std::ceil(1.01 * made.dither.cycle_ticks), g.bias_hz, g.bias_edge_s, g.tick_s, std::floor(max_ticks))};
    return made;
}

}  // namespace zlg::rig
