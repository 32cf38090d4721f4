#include "known_sum.hpp"

#include <zlg/core/common/as_double.hpp>

namespace zlg::core {
namespace {

// Part of the false angle of a stretch, at its most, by which the constants err: the quartic term of the bias, chi f0 and
// the reading of a large detuning.
constexpr double law_part = 0.03;

// What lock-in takes from the known sum of a gap's ticks, at their mean rate, given back to it.
void give_back_lock_in(const GyroCompensationConfig& config, double turn_counts, Hertz bias, TickInput& tick) noexcept {
    const double turn = 0.5 * turn_counts, of_bias = 0.5 * bias.value() * config.gyro.tick.value();
    const LostCounts lost = lost_to_lock_in(config.gyro, config.lock_in, turn + of_bias, turn - of_bias);
    const double arcsec = config.gyro.scale.value() * as_double(tick.known_ticks);
    const double scale = config.gyro.scale.value();
    tick.variance_arcsec2 += scale * scale * lost.variance;
    tick.known_arcsec += arcsec * lost.value;
    tick.known_variance_arcsec2 += arcsec * arcsec * lost.variance;
}

}  // namespace

void set_known_sum(const GyroCompensationConfig& config, GyroCompensationState& state, const HalfRecord& first,
                   const HalfRecord& second, const Borders& borders, const EdgeShiftState& edges_before,
                   TickInput& tick) noexcept {
    const CompensationConstants& gyro = config.gyro;
    const Hertz bias = bias_at(gyro, Celsius{first.temperature_c});
    const CountedStretch known =
        step(gyro, state.stretch, first, second, bias, edges_before, state.edges, borders.start);
    if (known.n_ticks == 0) return;
    const double unit = arcsec_per_lambda2(gyro, bias);
    const double drift_arcsec = unit * known.fall_lambda2;
    const double rounding = rounding_arcsec2(gyro, known.start_border, borders.end);
    double drift_variance = drift_arcsec * drift_arcsec;
    tick.known_ticks = known.n_ticks;
    tick.known_arcsec = known.angle_arcsec;
    const bool settles = !(drift_variance <= rounding_arcsec2(gyro));
    if (settles && known.seen) {
        tick.known_arcsec += unit * known.deficit_lambda2;
        drift_variance = law_part * law_part * drift_variance + unit * unit * known.deficit_variance_lambda4;
    }
    tick.known_is_rough = settles;
    tick.known_drift_arcsec2 = drift_variance;
    tick.known_variance_arcsec2 = rounding + walk_arcsec2(gyro) * as_double(known.n_ticks) + drift_variance;
    give_back_lock_in(config, state.edges.turn_counts, bias, tick);
    // What `step` has concluded from the sum about the edges holds for an even bias.
    if (settles) break_off(state.edges);
}

}  // namespace zlg::core
