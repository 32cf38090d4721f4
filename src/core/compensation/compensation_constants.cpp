#include <zlg/core/compensation/compensation_constants.hpp>

#include <zlg/core/common/maths.hpp>

#include "common/bounds.hpp"

namespace zlg::core {
namespace {

// No gyro is that warm or cold; beyond it the product with a coefficient need not be a number.
constexpr double max_temperature_c = 1e6;

}  // namespace

// Wider than any gyro, and narrow enough that no counts and no detuning of a record make a sum or a square that
// overflows.
GyroCompensationFault check(const CompensationConstants& g) noexcept {
    using Fault = GyroCompensationFault;
    if (!(is_within(g.tick.value(), 1e-9, 1e9) && is_within(g.scale.value(), 1e-9, 1e9))) return Fault::relock;
    if (!is_within(g.random_walk.value(), 0.0, 1e6)) return Fault::random_walk;
    const bool bias = g.bias.value() > 0.0 && g.bias.value() <= 1e15 && is_within(g.chi, 0.0, 1e6) &&
                      is_within(g.temperature_coefficient_per_c, -1.0, 1.0) &&
                      is_within(g.reference_temperature.value(), -max_temperature_c, max_temperature_c) &&
                      is_within(g.centre.value(), -max_centre.value(), max_centre.value());
    if (!bias) return Fault::relock;
    const bool edges = is_within(g.timer.value(), 1.0, 1e15) && is_within(g.plateau_ratio, 1.0, 2.0);
    if (!edges) return Fault::edges;
    const bool light = is_within(g.light_noise.value(), 0.0, 10.0) && g.light_samples >= 1 &&
                       is_within(g.fringe_noise_counts, 0.0, 1.0) && check(g.record_curve) == CurveFault::none &&
                       check(g.control_curve) == CurveFault::none;
    return light ? Fault::none : Fault::relock;
}

Hertz bias_at(const CompensationConstants& gyro, Celsius temperature) noexcept {
    if (!is_within(temperature.value(), -max_temperature_c, max_temperature_c)) return gyro.bias;
    const double above_c = temperature.value() - gyro.reference_temperature.value();
    return (1.0 + gyro.temperature_coefficient_per_c * above_c) * gyro.bias;
}

}  // namespace zlg::core
