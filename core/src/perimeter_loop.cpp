#include <zlg/core/perimeter_loop.hpp>

#include <zlg/core/maths.hpp>

#include "bounds.hpp"

namespace zlg::core {
namespace {

// Slow stage: one step of the integrator, in volts.
double correction_v(const PerimeterLoopConfig& c, Wavelengths detuning) noexcept {
    const double kp_lambda_v = 0.5 / c.half_wave.value();
    const double gain = c.half_period.value() / c.time_constant.value();
    return gain * limited(detuning.value(), c.error_limit.value()) / kp_lambda_v;
}

// Fast stage: what the high-voltage stage can follow within one half.
double slewed_v(const PerimeterLoopConfig& c, double move_v) noexcept {
    return limited(move_v, c.slew_v_s * c.half_period.value());
}

}  // namespace

PerimeterLoopOutput step(const PerimeterLoopConfig& config, PerimeterLoopState& state,
                         const PerimeterLoopInput& input) noexcept {
    const bool measured = input.usable && is_finite(input.detuning.value()) && input.was_closed;

    double wanted_v = state.set_point_v;
    if (!input.close) {
        if (is_finite(input.second_input.value())) wanted_v = input.second_input.value();
    } else if (config.kind == LoopKind::digital && measured) {
        wanted_v -= slewed_v(config, correction_v(config, input.detuning));
    }
    state.set_point_v = clamp(config.range, Volts{wanted_v}).value();

    const Volts set_point{state.set_point_v};
    const double size_lambda = input.detuning.value() < 0.0 ? -input.detuning.value() : input.detuning.value();
    return {.set_point = set_point,
            .saturated = state.set_point_v != wanted_v,
            .over_limit = measured && size_lambda > config.watch_limit.value(),
            .near_range_end = near_end(config.range, is_finite(input.piezo.value()) ? input.piezo : set_point)};
}

}  // namespace zlg::core
