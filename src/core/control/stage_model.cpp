#include "stage_model.hpp"

#include <zlg/core/common/maths.hpp>

#include "common/bounds.hpp"

namespace zlg::core {
namespace {

// Far below the resolution of any converter.
constexpr double negligible_v = 1e-6;

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
    const double gone_v = (command_v - corner_at_v) * (1.0 - maths::exp(-rest_s / m.rc_s));
    return {corner_at_v + gone_v, slewed_vs + command_v * rest_s - m.rc_s * gone_v};
}

// From farther away than this the limit of the current is felt throughout a piece, and the target itself is the
// command.
double slewing_from_v(const StageModel& m) noexcept { return m.slew_v_s * (m.rc_s + m.piece_s); }

// The command that brings a voltage within a piece's reach to the target.
double leading_v(const StageModel& m, double v, double target_v) noexcept {
    return v + limited((target_v - v) / (1.0 - m.decay), slewing_from_v(m));
}

Piece slewed(const StageModel& m, double v, double target_v) noexcept {
    const double end_v = v + (target_v > v ? m.slew_v_s : -m.slew_v_s) * m.piece_s;
    return {end_v, 0.5 * (v + end_v) * m.piece_s};
}

}  // namespace

StageModel stage_model(double rc_s, double slew_v_s, double piece_s) noexcept {
    return {.rc_s = rc_s, .slew_v_s = slew_v_s, .piece_s = piece_s, .decay = maths::exp(-piece_s / rc_s)};
}

StageMove move_towards(const StageModel& stage, const PiezoRange& range, double from_v, double target_v,
                       std::int32_t n) noexcept {
    StageMove move{.end_v = from_v};
    const double last_v = clamp(range, Volts{target_v}).value();
    const double far_v = slewing_from_v(stage);
    double integral_vs = 0.0;
    for (std::int32_t k = 0; k < n; ++k) {
        const bool is_far = size(last_v - move.end_v) > far_v;
        // The last set-point stays if the processor falls silent: it is the target.
        const bool leads = !is_far && k + 1 < n;
        const double command_v = leads ? clamp(range, Volts{leading_v(stage, move.end_v, last_v)}).value() : last_v;
        const bool rests = size(command_v - move.end_v) < negligible_v;
        const Piece piece = is_far  ? slewed(stage, move.end_v, last_v)
                            : rests ? Piece{move.end_v, move.end_v * stage.piece_s}
                                    : followed(stage, move.end_v, command_v);
        move.set_point_v[static_cast<std::size_t>(k)] = command_v;
        move.end_v = piece.end_v;
        integral_vs += piece.integral_vs;
    }
    move.mean_v = integral_vs / (n * stage.piece_s);
    return move;
}

}  // namespace zlg::core
