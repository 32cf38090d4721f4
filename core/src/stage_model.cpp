#include "stage_model.hpp"

#include <zlg/core/maths.hpp>

#include "bounds.hpp"

namespace zlg::core {
namespace {

struct Piece {
    double end_v;
    double integral_vs;
};

// Exact response to a command that holds for one piece: first at the limit of the current, then exponential.
Piece followed(const StageModel& m, double v, double command_v) noexcept {
    const double error_v = command_v - v;
    const double corner_v = m.slew_v_s * m.rc_s;  // lag below which the limit is not felt
    const double beyond_v = error_v - limited(error_v, corner_v);
    if (beyond_v == 0.0) {
        const double gone_v = error_v * (1.0 - m.decay);
        return {v + gone_v, command_v * m.piece_s - m.rc_s * gone_v};
    }
    const double slew_v_s = beyond_v > 0.0 ? m.slew_v_s : -m.slew_v_s;
    const double needed_s = beyond_v / slew_v_s;
    const double slewing_s = needed_s < m.piece_s ? needed_s : m.piece_s;
    const double corner_at_v = v + slew_v_s * slewing_s;
    const double slewed_vs = 0.5 * (v + corner_at_v) * slewing_s;
    if (!(needed_s < m.piece_s)) return {corner_at_v, slewed_vs};
    const double rest_s = m.piece_s - slewing_s;
    const double gone_v = (command_v - corner_at_v) * (1.0 - exponential(-rest_s / m.rc_s));
    return {corner_at_v + gone_v, slewed_vs + command_v * rest_s - m.rc_s * gone_v};
}

// Farther away than the current can move it in a piece, the target itself will do.
double leading_v(const StageModel& m, double v, double target_v) noexcept {
    const double most_v = m.slew_v_s * (m.rc_s + m.piece_s);
    const double error_v = target_v - v;
    if (error_v > most_v || error_v < -most_v) return target_v;
    return v + limited(error_v / (1.0 - m.decay), most_v);
}

}  // namespace

StageModel stage_model(double rc_s, double slew_v_s, double piece_s) noexcept {
    return {.rc_s = rc_s, .slew_v_s = slew_v_s, .piece_s = piece_s, .decay = exponential(-piece_s / rc_s)};
}

StageMove move_towards(const StageModel& stage, const PiezoRange& range, double from_v, double target_v,
                       std::int32_t n) noexcept {
    StageMove move{.end_v = from_v};
    double integral_vs = 0.0;
    for (std::int32_t k = 0; k < n; ++k) {
        // The last set-point stays if the processor falls silent: it is the target.
        const double wanted_v = k + 1 < n ? leading_v(stage, move.end_v, target_v) : target_v;
        const double command_v = clamp(range, Volts{wanted_v}).value();
        const Piece piece = followed(stage, move.end_v, command_v);
        move.set_point_v[static_cast<std::size_t>(k)] = command_v;
        move.end_v = piece.end_v;
        integral_vs += piece.integral_vs;
    }
    move.mean_v = integral_vs / (n * stage.piece_s);
    return move;
}

}  // namespace zlg::core
