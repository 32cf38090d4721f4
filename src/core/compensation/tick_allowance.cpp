#include "tick_allowance.hpp"

#include <zlg/core/common/maths.hpp>

#include "common/bounds.hpp"

namespace zlg::core {
namespace {

// Square of the number of standard deviations of a settled tick from which on a false angle is taken to be real.
constexpr double unsubtracted_gate_sq = 9.0;

// Part of the variance of a tick up to which a false angle is not looked for.
constexpr double hidden_part = 0.25;

// What a half may hold of a fault that begins or ends in it, over the bias: a change of the current is seen from 1.2 % of it
// on, darkness from one sample's time.
constexpr double unseen_part = 0.01;

}  // namespace

double unseen_arcsec2(const CompensationConstants& gyro) noexcept {
    return square(unseen_part * 0.5 * gyro.tick.value() * gyro.bias.value() * gyro.scale.value());
}

void allow_for_push(const CompensationConstants& gyro, const RelockDriftConfig& config, const RelockDriftState& relock,
                    const RelockTick& read, TickInput& tick) noexcept {
    if (relock.armed && relock.since_gap < config.ticks) return;
    if (config.method == RelockMethod::none || config.method == RelockMethod::frequency) return;
    const double unit = arcsec_per_lambda2(gyro, gyro.bias);
    const double change_lambda2 = read.second.detuning_sq_lambda2 - read.first.detuning_sq_lambda2;
    if (square(unit * change_lambda2) <= hidden_part * tick.variance_arcsec2) return;
    RelockDriftState closing{.armed = true};
    const FalseAngle left = step(gyro, config, closing, read).tick;
    // Of the difference of two mean squares of n samples of noise.
    const double settled_arcsec2 = 4.0 * square(unit * square(gyro.light_noise.value())) / gyro.light_samples;
    if (left.known && square(left.value_arcsec) > unsubtracted_gate_sq * settled_arcsec2)
        tick.variance_arcsec2 += square(left.value_arcsec) + left.variance_arcsec2;
}

}  // namespace zlg::core
