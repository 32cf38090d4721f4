#include "tick_allowance.hpp"

namespace zlg::core {
namespace {

// Square of the number of standard deviations from which on a false angle that no correction subtracts is taken to be real.
constexpr double unsubtracted_gate_sq = 9.0;

// Part of the variance of a tick up to which a false angle is not looked for.
constexpr double hidden_part = 0.25;

// Mean square of the detuning about its mean in a tick, over that of the light's noise, from which on the perimeter moves.
constexpr double moving_ratio = 2.0;

bool is_moving(const CompensationConstants& gyro, const RelockTick& read) noexcept {
    const double mean_lambda = 0.5 * (read.detuning_first_lambda + read.detuning_second_lambda);
    const double mean_sq_lambda2 = 0.5 * (read.detuning_sq_first_lambda2 + read.detuning_sq_second_lambda2);
    const double noise = gyro.light_noise.value();
    return mean_sq_lambda2 - mean_lambda * mean_lambda > moving_ratio * noise * noise;
}

// What a half may hold of a fault that begins or ends in it, over the bias: a change of the current is seen from 1.2 % of it
// on, darkness from one sample's time.
constexpr double unseen_part = 0.01;

double unseen_arcsec2(const CompensationConstants& gyro) noexcept {
    const double unseen = unseen_part * 0.5 * gyro.tick.value() * gyro.bias.value() * gyro.scale.value();
    return unseen * unseen;
}

}  // namespace

void allow_for_push(const CompensationConstants& gyro, const RelockDriftConfig& config, const RelockDriftState& relock,
                    const RelockTick& read, TickInput& tick) noexcept {
    if (relock.armed && relock.since_gap < config.ticks) return;
    const double change_lambda2 = read.detuning_sq_second_lambda2 - read.detuning_sq_first_lambda2;
    const double shown_arcsec = arcsec_per_lambda2(gyro, gyro.bias) * change_lambda2;
    const bool moves = is_moving(gyro, read);
    if (!moves && shown_arcsec * shown_arcsec <= hidden_part * tick.variance_arcsec2) return;
    if (config.method == RelockMethod::none || config.method == RelockMethod::frequency) return;
    RelockDriftState closing{.armed = true};
    const FalseAngle residual = step(gyro, config, closing, read).tick;
    if (!residual.known) return;
    const double sq = residual.value_arcsec * residual.value_arcsec;
    double unsubtracted = 0.0;
    if (moves)
        unsubtracted = sq + residual.variance_arcsec2;
    else if (sq > unsubtracted_gate_sq * residual.variance_arcsec2)
        unsubtracted = sq;
    tick.variance_arcsec2 += unsubtracted;
}

void allow_for_onset(const CompensationConstants& gyro, TickInput& tick) noexcept {
    tick.amend_previous = true;
    tick.amend_variance_arcsec2 = unseen_arcsec2(gyro);
}

void allow_for_end(const CompensationConstants& gyro, TickInput& tick) noexcept {
    tick.variance_arcsec2 += unseen_arcsec2(gyro);
    tick.relock_variance_arcsec2 += unseen_arcsec2(gyro);
}

}  // namespace zlg::core
