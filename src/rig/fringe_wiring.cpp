#include "fringe_wiring.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <zlg/core/common/maths.hpp>

#include "bias_wiring.hpp"

namespace zlg::rig {
namespace {

constexpr double turn_rad = 2.0 * std::numbers::pi;

// Noise and converter of both photodiodes, as an angle on the circle of amplitude 1.
double noise_turns(const config::Photodiodes& p) {
    const double step = std::ldexp(2.0 * twin::photodiode_range, -p.adc_bits);
    return std::sqrt(p.noise * p.noise + step * step / 12.0) / turn_rad;
}

// While the bias is reversed the phase goes on by f t^2/t_e in a time t beside its middle: root mean square over the
// jitter.
double jitter_counts(const config::Config& config) {
    const config::Gyro& g = config.gyro;
    const double jitter_s = config.photodiodes.jitter_s;
    const double edge_s = std::max(g.bias_edge_s, 2.0 * jitter_s);
    return edge_s > 0.0 ? std::numbers::sqrt3 * plateau_ratio(g) * g.bias_hz * jitter_s * jitter_s / edge_s : 0.0;
}

int counts_per_turn(const config::Config& config) {
    return config.gyro.fidelity == config::Fidelity::laser ? twin::counts_per_turn(config.laser.quadrature) : 1;
}

// A sample that is taken this much off the latch is reported; up to 1 us is supported. Less than a five-hundredth of a
// turn does not show among the quarters of the comparators.
double max_skew_turns(const config::Config& config) {
    constexpr double reported_s = 1.5e-6;
    constexpr double least_turns = 0.002;
    const config::Gyro& g = config.gyro;
    const double plateau_hz = plateau_ratio(g) * g.bias_hz / counts_per_turn(config);
    const double edge_s = std::max(g.bias_edge_s, 2.0 * reported_s);
    return std::max(least_turns, plateau_hz * reported_s * reported_s / edge_s);
}

// r^2 t_e/(4 f) of one count a half.
double turned_back_turns(const config::Config& config) {
    const config::Gyro& g = config.gyro;
    const double turns_s = 1.0 / (counts_per_turn(config) * 0.5 * g.tick_s);
    const double plateau_hz = plateau_ratio(g) * g.bias_hz / counts_per_turn(config);
    return std::min(0.25 * turns_s * turns_s * g.bias_edge_s / plateau_hz, 1.0);
}

}  // namespace

core::FringeReadoutConfig fringe_readout_of(const config::Config& config) {
    if (config.gyro.readout != config::Readout::phase) return {};
    core::FringeReadoutConfig made{.reads = true,
                                   .counts_per_turn = counts_per_turn(config),
                                   .limit = 0.999 * twin::photodiode_range,
                                   .noise_turns = std::min(noise_turns(config.photodiodes), 0.05),
                                   .max_skew_turns = max_skew_turns(config)};
    // The comparators of the averaged gyro have no threshold.
    if (config.gyro.fidelity == config::Fidelity::laser) {
        made.lag_turns = core::maths::asin(config.laser.comparator_threshold) / turn_rad;
        made.turned_back_turns = turned_back_turns(config);
    }
    return made;
}

double fringe_noise_counts(const config::Config& config) {
    return std::min(
        core::maths::hypot(counts_per_turn(config) * noise_turns(config.photodiodes), jitter_counts(config)), 1.0);
}

}  // namespace zlg::rig
