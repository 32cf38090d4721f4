#include "tick_allowance.hpp"

#include <zlg/core/common/maths.hpp>

#include "common/bounds.hpp"

namespace zlg::core {
namespace {

// Square of the number of standard deviations from which on a false angle that no correction subtracts is taken to be real.
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
    const double change_lambda2 = read.detuning_sq_second_lambda2 - read.detuning_sq_first_lambda2;
    const double shown_arcsec = arcsec_per_lambda2(gyro, gyro.bias) * change_lambda2;
    if (square(shown_arcsec) <= hidden_part * tick.variance_arcsec2) return;
    if (config.method == RelockMethod::none || config.method == RelockMethod::frequency) return;
    RelockDriftState closing{.armed = true};
    const FalseAngle residual = step(gyro, config, closing, read).tick;
    if (!residual.known) return;
    const double sq = square(residual.value_arcsec);
    if (sq > unsubtracted_gate_sq * residual.variance_arcsec2) tick.variance_arcsec2 += sq;
}

}  // namespace zlg::core
