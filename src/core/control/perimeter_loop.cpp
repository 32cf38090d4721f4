#include <zlg/core/control/perimeter_loop.hpp>

#include <zlg/core/common/maths.hpp>

#include "common/bounds.hpp"
#include "stage_model.hpp"

namespace zlg::core {
namespace {

// A perimeter that was farther from its target in the mean of the last open half may still have shown the light of the
// old mode. Set by hand, a fifth of the distance to the next mode's centre.
constexpr double max_in_flight_lambda = 0.1;

// Learning of the slew rate. A voltage that is farther from its set-point at the closing has another cause than the
// stage, and is not learnt from; one switch changes the rate by at most a tenth, half of the error. Set by hand.
constexpr double arrived_lambda = 0.05;
constexpr double max_slew_error = 0.2;

double volts_per_lambda(const PerimeterLoopConfig& c) noexcept { return 2.0 * c.half_wave.value(); }

// One step of the integrator, in volts.
double correction_v(const PerimeterLoopConfig& c, double detuning_lambda) noexcept {
    const double kp_lambda_v = 0.5 / c.half_wave.value();
    const double gain = c.half_period.value() / c.time_constant.value();
    return gain * limited(detuning_lambda, c.error_limit.value()) / kp_lambda_v;
}

// What the high-voltage stage can follow within one half.
double slewed_v(const PerimeterLoopConfig& c, double move_v) noexcept {
    return limited(move_v, c.slew_v_s * c.half_period.value());
}

bool relocks(const PerimeterLoopConfig& c) noexcept { return c.kind == LoopKind::digital && c.relock_halves > 0; }

// The correction of a loop that allows for the motion in flight, in volts: p of the header, times the gain.
double relocking_v(const PerimeterLoopConfig& c, const PerimeterLoopState& s, const PerimeterLoopInput& in) noexcept {
    const double in_flight_lambda = (s.set_point_v - s.mean_v) / volts_per_lambda(c);
    if (!in.was_closed && limited(in_flight_lambda, max_in_flight_lambda) != in_flight_lambda) return 0.0;
    const double leads_to_lambda = in.detuning.value() + in_flight_lambda;
    if (s.n_closed < c.relock_halves) return c.relock_gain * leads_to_lambda * volts_per_lambda(c);
    return correction_v(c, leads_to_lambda);
}

double wanted_v(const PerimeterLoopConfig& c, const PerimeterLoopState& s, const PerimeterLoopInput& in) noexcept {
    if (!in.close) return is_finite(in.second_input.value()) ? in.second_input.value() : s.set_point_v;
    const bool seen = in.usable && is_finite(in.detuning.value());
    if (!seen || c.kind != LoopKind::digital) return s.set_point_v;
    if (relocks(c)) return s.set_point_v - relocking_v(c, s, in);
    return in.was_closed ? s.set_point_v - slewed_v(c, correction_v(c, in.detuning.value())) : s.set_point_v;
}

// Measure the slew rate in a half through which the stage slews (0.95 of the possible move, so that its end is not in
// it), and learn it at the closing, if the voltage has arrived.
void watch_slew(const PerimeterLoopConfig& c, PerimeterLoopState& s, const PerimeterLoopInput& in) noexcept {
    if (in.was_closed || !plausible(c.range, in.piezo)) return;
    const double presumed_v = s.end_v - s.start_v;
    const double max_v = c.slew_v_s * s.slew_ratio * c.half_period.value();
    if (size(presumed_v) > 0.95 * max_v) {
        s.slew_error = limited((in.piezo.value() - s.end_v) / (s.end_v - s.opened_v), max_slew_error);
        s.has_slew_error = true;
    }
    if (!in.close) return;
    const double off_v = in.piezo.value() - s.set_point_v;
    const bool arrived = limited(off_v, arrived_lambda * volts_per_lambda(c)) == off_v;
    if (s.has_slew_error && arrived) {
        const double ratio = s.slew_ratio * (1.0 + 0.5 * s.slew_error);
        s.slew_ratio = ratio < 0.25 ? 0.25 : (ratio > 4.0 ? 4.0 : ratio);
    }
    s.has_slew_error = false;
}

// The voltage of a loop that follows no model of the stage is known by its reading only.
void hold(const PerimeterLoopConfig& c, PerimeterLoopState& s, const PerimeterLoopInput& in) noexcept {
    const double now_v = plausible(c.range, in.piezo) ? clamp(c.range, in.piezo).value() : s.set_point_v;
    s.start_v = s.mean_v = s.end_v = now_v;
}

void drive(const PerimeterLoopConfig& c, PerimeterLoopState& s, const PerimeterLoopInput& in,
           PerimeterLoopOutput& out) noexcept {
    if (!in.close && in.was_closed && !relocks(c)) hold(c, s, in);
    s.n_closed = in.close ? s.n_closed : 0;
    if (in.close) count_up(s.n_closed);
    out.n_set_points = c.set_points;
    const StageModel stage =
        stage_model(c.stage_time_constant.value(), c.slew_v_s * s.slew_ratio, c.half_period.value() / out.n_set_points);
    const StageMove move = move_towards(stage, c.range, s.end_v, s.set_point_v, out.n_set_points);
    if (in.was_closed && !in.close) s.opened_v = s.end_v;
    s.start_v = s.end_v;
    s.mean_v = move.mean_v;
    s.end_v = move.end_v;
    out.set_point_v = move.set_point_v;
}

}  // namespace

PerimeterLoopOutput step(const PerimeterLoopConfig& config, PerimeterLoopState& state,
                         const PerimeterLoopInput& input) noexcept {
    watch_slew(config, state, input);
    state.set_point_v = clamp(config.range, Volts{wanted_v(config, state, input)}).value();
    const bool measured = input.usable && is_finite(input.detuning.value()) && input.was_closed;
    const Volts piezo = is_finite(input.piezo.value()) ? input.piezo : Volts{state.set_point_v};
    PerimeterLoopOutput out;
    out.over_limit = measured && size(input.detuning.value()) > config.watch_limit.value();
    out.near_range_end = near_end(config.range, piezo);
    out.set_point_v[0] = state.set_point_v;
    if (relocks(config) || !input.close) drive(config, state, input, out);
    return out;
}

}  // namespace zlg::core
