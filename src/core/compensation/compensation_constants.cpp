#include <zlg/core/compensation/compensation_constants.hpp>

#include <zlg/core/common/maths.hpp>

#include "common/bounds.hpp"

namespace zlg::core {
namespace {

constexpr double max_bend = 1e15;

// No gyro is that warm or cold; beyond it the product with a coefficient need not be a number.
constexpr double max_temperature_c = 1e6;

}  // namespace

// Wider than any gyro, and narrow enough that no counts and no detuning of a record make a sum or a square that
// overflows.
GyroCompensationFault check(const CompensationConstants& g) noexcept {
    using Fault = GyroCompensationFault;
    if (!(is_within(g.tick.value(), 1e-9, 1e9) && is_within(g.scale.value(), 1e-9, 1e9))) return Fault::relock;
    if (!is_within(g.random_walk.value(), 0.0, 1e6)) return Fault::random_walk;
    const bool bias = g.bias.value() > 0.0 && g.bias.value() <= 1e15 && is_within(g.chi, -1e6, 1e6) &&
                      is_within(g.temperature_coefficient_per_c, -1.0, 1.0) &&
                      is_within(g.reference_temperature.value(), -max_temperature_c, max_temperature_c) &&
                      is_within(g.centre.value(), -max_centre.value(), max_centre.value()) &&
                      is_within(g.bend.term[0], -max_bend, max_bend) &&
                      is_within(g.bend.term[1], -max_bend, max_bend) && is_within(g.bend.term[2], -max_bend, max_bend);
    if (!bias) return Fault::relock;
    const bool edges = is_within(g.timer.value(), 1.0, 1e15) && is_within(g.plateau_ratio, 1.0, 2.0);
    if (!edges) return Fault::edges;
    const bool light = is_within(g.light_noise.value(), 0.0, 10.0) && g.light_samples >= 1 &&
                       is_within(g.fringe_noise_counts, 0.0, 1.0) && check(g.record_curve) == CurveFault::none &&
                       check(g.control_curve) == CurveFault::none;
    return light ? Fault::none : Fault::relock;
}

double most_loss(const LossBend& bend, double sq_lambda2) noexcept {
    const auto& [b0, b1, b2] = bend.term;
    return loss_at({{size(b0), size(b1), size(b2)}}, sq_lambda2).value;
}

double spread_lambda2(const CompensationConstants& gyro, const TrueMoments& seen) noexcept {
    return seen.mean_sq_lambda2 - square(seen.mean_lambda) - square(seen.slope * gyro.light_noise.value());
}

double beyond_square(const CompensationConstants& gyro, const TrueMoments& seen, double part) noexcept {
    if (gyro.bend == LossBend{}) return 0.0;
    const double spread_sq = part * spread_lambda2(gyro, seen);
    const double spread = spread_sq > 0.0 ? square_root(spread_sq) : 0.0;
    const double middle = seen.mean_lambda - gyro.centre.value();
    const double above = square(middle + spread), below = square(middle - spread);
    return 0.5 * (loss_at(gyro.bend, above).value - above + loss_at(gyro.bend, below).value - below);
}

Hertz bias_at(const CompensationConstants& gyro, Celsius temperature) noexcept {
    if (!is_within(temperature.value(), -max_temperature_c, max_temperature_c)) return gyro.bias;
    const double above_c = temperature.value() - gyro.reference_temperature.value();
    return (1.0 + gyro.temperature_coefficient_per_c * above_c) * gyro.bias;
}

}  // namespace zlg::core
