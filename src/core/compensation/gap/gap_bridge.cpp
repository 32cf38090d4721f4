#include <zlg/core/compensation/gap_bridge.hpp>

#include <memory>

#include <zlg/core/common/as_double.hpp>
#include <zlg/core/common/maths.hpp>
#include <zlg/core/compensation/border.hpp>

#include "common/bounds.hpp"
#include "gap_estimate.hpp"
#include "gap_interpolation.hpp"
#include "gap_known.hpp"
#include "gap_points.hpp"
#include "polynomial_motion.hpp"
#include "row_outlier.hpp"

namespace zlg::core {
namespace {

void begin_gap(const GapBridgeConfig& config, GapBridgeState& state, std::int64_t tick,
               std::int64_t settled_tick) noexcept {
    OpenGap& open = state.gap;
    open.open = true;
    open.gap.first_tick = tick;
    open.gap.settled_tick = settled_tick;
    Points points;
    points.collect(state, tick - 1, 1 - config.extrapolation_points, 0, tick);
    if (points.n == 0) return;
    open.gap.has_before = true;
    open.gap.mode_before = at(state, tick - 1).row.mode;
    const int order = order_in_place(config, state);
    std::construct_at(&open.fit, points.position, points.n, order);
    open.lower_order = open.fit.order() < order;
    const double n = points.n;
    for (unsigned k = 0; k < static_cast<unsigned>(points.n); ++k) {
        const HistoryTick& point = at(state, tick - 1 + points.position[k]);
        open.value_arcsec[k] = point.row.dtheta_final_arcsec;
        open.variance_arcsec2[k] = point.variance_arcsec2;
        open.constant_arcsec += open.value_arcsec[k] / n;
    }
}

// A row of a gap without an estimate.
void set_unrepaired(const OpenGap& open, AngleRow& row) noexcept {
    row.dtheta_final_arcsec = open.constant_arcsec;
    row.sigma_arcsec = infinity;
    row.flags |= flag_unrepaired;
}

// A row of a gap that is extrapolated from the ticks before it.
void set_extrapolated(AngleRow& row, double value_arcsec, double variance_arcsec2) noexcept {
    row.dtheta_arcsec = value_arcsec;
    row.dtheta_final_arcsec = value_arcsec;
    row.sigma_arcsec = deviation(variance_arcsec2);
}

// dtheta of the gap's tick j, and what its final value is if the log ends here.
void extrapolate(const CompensationConstants& gyro, const GapBridgeState& state, HistoryTick& entry,
                 std::int32_t j) noexcept {
    const OpenGap& open = state.gap;
    AngleRow& row = entry.row;
    row.flags |= flag_extrapolated;
    if (!open.gap.has_before || j > max_gap_ticks) {
        row.dtheta_arcsec = open.constant_arcsec;
        return set_unrepaired(open, row);
    }
    const GapPrediction& predicted = state.prediction;
    if (predicted.first_tick == open.gap.first_tick) {
        const auto k = static_cast<unsigned>(j - 1);
        return set_extrapolated(row, predicted.value_arcsec[k], predicted.variance_arcsec2[k]);
    }
    const double usual = rounding_arcsec2(gyro, state.learning.moments.with_phase);
    const FitWeights w = open.fit.weights(j);
    double sum = 0.0;
    double variance = 0.0;
    for (unsigned k = 0; k < static_cast<unsigned>(open.fit.n()); ++k) {
        sum += w[k] * open.value_arcsec[k];
        variance += w[k] * w[k] * open.variance_arcsec2[k];
        // Neighbouring ticks share a rounding, so their covariance is negative.
        if (neighbours(open.fit, static_cast<int>(k)))
            variance -=
                shared_rounding(usual, open.variance_arcsec2[k - 1], open.variance_arcsec2[k]) * w[k] * w[k - 1];
    }
    set_extrapolated(row, sum, variance);
    if (open.lower_order) row.flags |= flag_lower_order;
}

// The gap has become too long. Only its first ticks were delivered with another than their final value, and they may
// have left the history before the gap ends.
void give_up(GapBridgeState& state) noexcept {
    Gap& gap = state.gap.gap;
    ExactSum difference;
    for (int k = 0; k < max_gap_ticks; ++k) {
        AngleRow& row = at(state, gap.first_tick + k).row;
        set_unrepaired(state.gap, row);
        difference.add(row.dtheta_final_arcsec);
        difference.add(-row.dtheta_arcsec);
    }
    gap.final_minus_delivered_arcsec = difference;
}

void add_gap_tick(const CompensationConstants& gyro, const GapBridgeConfig& config, GapBridgeState& state,
                  const TickInput& input, std::int64_t tick) noexcept {
    if (!state.gap.open) {
        begin_gap(config, state, tick, input.settled_tick);
        if (is_estimated(config) && state.gap.gap.has_before) predict_gap(gyro, config, state, tick);
    }
    Gap& gap = state.gap.gap;
    ++gap.n;
    HistoryTick& entry = at(state, tick);
    if (gap.has_before && input.mode != gap.mode_before) entry.row.flags |= flag_switching;
    if (config.method == BridgeMethod::none) {
        entry.row.dtheta_arcsec = entry.row.dtheta_final_arcsec = input.value_arcsec;
        entry.row.sigma_arcsec = infinity;
        return;
    }
    const auto j = static_cast<std::int32_t>(gap.n <= max_gap_ticks ? gap.n : max_gap_ticks + 1);
    extrapolate(gyro, state, entry, j);
    note_known(rounding_arcsec2(gyro, state.learning.moments.with_phase), input, gap, entry);
    if (gap.n <= max_gap_ticks) return;
    // Its rows become final before its end is known.
    if (gap.n == max_gap_ticks + 1) give_up(state);
    const std::int64_t first = gap.n == max_gap_ticks + 1 ? gap.first_tick : tick;
    const ExactSum change =
        settle_known(gyro, config, state, gap, first, tick, state.gap.constant_arcsec).change_arcsec;
    gap.final_minus_delivered_arcsec.add(change.high);
    gap.final_minus_delivered_arcsec.add(change.low);
}

// Each half of the gap that is no point may turn by as much as the lit ones beside it show.
double unread_arcsec2(const LitHalvesState& lit, std::int64_t gap_ticks, std::int64_t end) noexcept {
    return lit.end_tick == end ? lit.turned_arcsec2 * static_cast<double>(2 * gap_ticks - lit.n) : 0.0;
}

// The first tick after a gap: from here on the gap waits.
void end_gap(const GapBridgeConfig& config, GapBridgeState& state, const TickInput& input, std::int64_t tick) noexcept {
    const bool at_start = !state.gap.gap.has_before && config.extrapolation_points > ticks_to_correction(config);
    // There eq (14) is used in reversed time and needs its points after the gap.
    const int wait = at_start ? config.extrapolation_points : ticks_to_correction(config);
    // A guard: in the 13 ticks that a gap waits at most, no more than 7 gaps can end.
    if (state.n_pending < max_pending_gaps) {
        state.pending[static_cast<unsigned>(state.n_pending++)] =
            PendingGap{.gap = state.gap.gap,
                       .due_tick = tick + wait,
                       .sign_after = input.sign,
                       .mode_after = input.mode,
                       .unread_arcsec2 = unread_arcsec2(state.lit, state.gap.gap.n, tick)};
    }
    state.gap = OpenGap{};
}

// Give a gap its final rows.
//
// more_arcsec2  variance of each row beyond that of the fit.
// return        final minus delivered.
ExactSum interpolate(GapBridgeState& state, const Gap& gap, const GapSums& sums, bool lower_order,
                     double more_arcsec2) noexcept {
    std::uint32_t gained = gap.has_before ? std::uint32_t{flag_interpolated} : 0u;
    if (lower_order) gained |= flag_lower_order;
    ExactSum difference;
    for (unsigned j = 0; j < static_cast<unsigned>(gap.n); ++j) {
        AngleRow& row = at(state, gap.first_tick + j).row;
        row.dtheta_final_arcsec = sums.value_arcsec[j];
        row.sigma_arcsec = deviation(sums.variance_arcsec2[j] + more_arcsec2);
        row.flags = (row.flags & ~(std::uint32_t{flag_unrepaired} | flag_lower_order)) | gained;
        if (!is_finite(row.sigma_arcsec)) row.flags |= flag_unrepaired;
        difference.add(row.dtheta_final_arcsec);
        difference.add(-row.dtheta_arcsec);
    }
    return difference;
}

// Give a gap its final rows by a polynomial, and its report their deviation.
//
// return  final minus delivered.
ExactSum fit(const CompensationConstants& gyro, const GapBridgeConfig& config, GapBridgeState& state, const Gap& gap,
             std::int64_t end, const EstimatedAngle& found, GapReport& report) noexcept {
    const double judged = found.polynomial_variance_arcsec2;
    const bool is_judged = judged > 0.0;
    GapSums sums = is_estimated(config) && !is_judged ? sums_with_motion(gyro, config, state, gap, end, found.order)
                                                      : sums_of(gyro, config, state, gap, end, found.order);
    // The polynomial stands in for an estimate, because nothing is known of the motion yet.
    const bool in_place = is_estimated(config) && !found.has_history;
    // An estimate judges with the re-lock behind the points.
    if (!is_judged) sums.angle_variance_arcsec2 += relock_beyond(state, gap, end, config.points_after);
    const double variance = sums.angle_variance_arcsec2;
    report.sigma_sum_arcsec = deviation(judged > 0.0 ? judged : variance);
    // As an error that all rows have in common, whose sum is n times that of one.
    const auto n = static_cast<double>(gap.n);
    const double more = variance < judged ? (judged - variance) / (n * n) : 0.0;
    return interpolate(state, gap, sums, in_place || sums.fit.order() < found.order, more);
}

// Add a variance to the angle of a gap: to each of its ticks an equal part.
void widen(GapBridgeState& state, const Gap& gap, double variance_arcsec2, GapReport& report) noexcept {
    const double of_tick = variance_arcsec2 / static_cast<double>(gap.n);
    for (std::int64_t j = 0; j < gap.n; ++j) {
        double& sigma = at(state, gap.first_tick + j).row.sigma_arcsec;
        sigma = square_root(sigma * sigma + of_tick);
    }
    report.sigma_sum_arcsec = square_root(report.sigma_sum_arcsec * report.sigma_sum_arcsec + variance_arcsec2);
}

// An error that the points beside a gap have in common goes over to each of its ticks, and with those of the re-lock into the
// angle of the switch, all with one sign.
void widen_in_common(GapBridgeState& state, const Gap& gap, GapReport& report) noexcept {
    for (std::int64_t j = 0; j < gap.n; ++j) {
        double& sigma = at(state, gap.first_tick + j).row.sigma_arcsec;
        sigma = square_root(sigma * sigma + state.common_arcsec2);
    }
    const double n_ticks = as_double(gap.n + state.relock_ticks);
    report.sigma_sum_arcsec = square_root(square(report.sigma_sum_arcsec) + n_ticks * n_ticks * state.common_arcsec2);
}

// Work at the end of a log, in the units of `estimate`: unbounded.
constexpr int all_work = 1000;

// Give a gap its final values from the ticks before `end`, and its pending correction, eq (17).
GapReport resolve(const CompensationConstants& gyro, const GapBridgeConfig& config, GapBridgeState& state,
                  PendingGap& pending, std::int64_t end, int work) noexcept {
    Gap& gap = pending.gap;
    GapReport report{.first_tick = gap.first_tick,
                     .n_ticks = gap.n,
                     .sign_after = pending.sign_after,
                     .mode_after = pending.mode_after,
                     .mode_changed = pending.mode_after != gap.mode_before,
                     .sigma_sum_arcsec = infinity};
    pending.resolved = true;
    if (config.method == BridgeMethod::none) return report;
    ExactSum difference = gap.final_minus_delivered_arcsec;
    if (gap.n <= max_gap_ticks) {
        const EstimatedAngle found = is_estimated(config) ? estimate(gyro, config, state, gap, end, work)
                                                          : EstimatedAngle{.order = order_of(config.method)};
        difference = found.known ? found.gap_arcsec : fit(gyro, config, state, gap, end, found, report);
        if (found.known) report.sigma_sum_arcsec = found.sigma_sum_arcsec;
        if (pending.unread_arcsec2 > 0.0) widen(state, gap, pending.unread_arcsec2, report);
        pending.correction_arcsec.add(found.after_arcsec.high);
        pending.correction_arcsec.add(found.after_arcsec.low);
        const KnownShift known =
            settle_known(gyro, config, state, gap, gap.first_tick, gap.first_tick + gap.n - 1, 0.0);
        difference.add(known.change_arcsec.high);
        difference.add(known.change_arcsec.low);
        if (known.variance_arcsec2 > 0.0)
            report.sigma_sum_arcsec = deviation(square(report.sigma_sum_arcsec) + known.variance_arcsec2);
    }
    if (is_known(gap))
        report.sigma_sum_arcsec = deviation(gap.known_variance_arcsec2);
    else if (gap.n <= max_gap_ticks && state.common_arcsec2 > 0.0)
        widen_in_common(state, gap, report);
    report.dp_arcsec = -difference.value();
    pending.correction_arcsec.add(difference.high);
    pending.correction_arcsec.add(difference.low);
    return report;
}

// dtheta of a measured tick: its value, and the corrections of gaps that are due. Sums are exact, and the rounding
// residual goes into the next correction.
double deliver(const GapBridgeConfig& config, GapBridgeState& state, HistoryTick& entry, std::int64_t tick) noexcept {
    ExactSum sum = state.rounding_residual_arcsec;
    sum.add(entry.row.dtheta_final_arcsec);
    int kept = 0;
    // Without a bridge only a late re-lock correction can be pending.
    bool is_correction = config.method != BridgeMethod::none;
    for (int k = 0; k < state.n_pending; ++k) {
        const PendingGap& pending = state.pending[static_cast<unsigned>(k)];
        if (pending.due_tick > tick) {
            if (kept != k) state.pending[static_cast<unsigned>(kept)] = pending;
            ++kept;
            continue;
        }
        sum.add(pending.correction_arcsec.high);
        sum.add(pending.correction_arcsec.low);
        is_correction = is_correction || pending.correction_arcsec != ExactSum{};
    }
    if (kept == state.n_pending) return entry.row.dtheta_final_arcsec;
    for (int k = kept; k < state.n_pending; ++k) state.pending[static_cast<unsigned>(k)] = PendingGap{};
    state.n_pending = kept;
    if (!is_correction) return entry.row.dtheta_final_arcsec;
    entry.row.flags |= flag_correction;
    const double delivered = sum.value();
    sum.add(-delivered);
    state.rounding_residual_arcsec = sum;
    return delivered;
}

void amend_previous(GapBridgeState& state, const TickInput& input, std::int64_t tick) noexcept {
    HistoryTick& entry = at(state, tick - 1);
    const double before_arcsec = entry.row.dtheta_final_arcsec;
    entry.row.dtheta_final_arcsec += input.amend_arcsec;
    entry.row.relock_arcsec -= input.amend_arcsec;
    entry.variance_arcsec2 += input.amend_variance_arcsec2;
    entry.relock_variance_arcsec2 += input.amend_variance_arcsec2;
    entry.row.sigma_arcsec = square_root(entry.variance_arcsec2);
    entry.row.flags |= input.amend_flags;
    // The tick was the first after the gap that ended last.
    if (state.n_pending > 0) {
        PendingGap& pending = state.pending[static_cast<unsigned>(state.n_pending - 1)];
        pending.correction_arcsec.add(entry.row.dtheta_final_arcsec);
        pending.correction_arcsec.add(-before_arcsec);
    }
}

void add_measured_tick(const GapBridgeConfig& config, GapBridgeState& state, const TickInput& input,
                       std::int64_t tick) noexcept {
    if (state.gap.open) end_gap(config, state, input, tick);
    HistoryTick& entry = at(state, tick);
    entry.row.dtheta_final_arcsec = input.value_arcsec;
    entry.row.dtheta_arcsec = state.n_pending > 0 ? deliver(config, state, entry, tick) : input.value_arcsec;
    entry.row.sigma_arcsec = square_root(input.variance_arcsec2);
}

// Its estimate is there, and a later gap waits for the memory that it lies in: that one would not be ready in time.
bool makes_room(const GapBridgeState& state, int k) noexcept {
    const EstimatedGap& e = state.estimate;
    return k + 1 < state.n_pending && e.solution.done &&
           e.first_tick == state.pending[static_cast<unsigned>(k)].gap.first_tick;
}

// return  some gap was due.
bool resolve_due(const CompensationConstants& gyro, const GapBridgeConfig& config, GapBridgeState& state,
                 std::int64_t tick, AngleSample& sample) noexcept {
    bool any = false;
    for (int k = 0; k < state.n_pending; ++k) {
        PendingGap& pending = state.pending[static_cast<unsigned>(k)];
        if (pending.resolved || (pending.due_tick > tick && !makes_room(state, k))) continue;
        any = true;
        const GapReport report = resolve(gyro, config, state, pending, tick, work_a_half);
        if (!pending.gap.has_before) continue;
        sample.has_gap = true;
        sample.gap = report;
    }
    return any;
}

}  // namespace

AngleSample step(const CompensationConstants& gyro, const GapBridgeConfig& config, GapBridgeState& state,
                 const TickInput& input) noexcept {
    const std::int64_t tick = state.next_tick++;
    AngleSample sample{.tick = tick};
    if (input.amend_previous && tick > 0) amend_previous(state, input, tick);
    const bool resolved = state.n_pending > 0 && resolve_due(gyro, config, state, tick, sample);

    HistoryTick& entry = at(state, tick);
    entry = HistoryTick{
        .row = {.tick = tick, .relock_arcsec = input.relock_arcsec, .mode = input.mode, .flags = input.flags},
        .variance_arcsec2 = input.variance_arcsec2,
        .relock_variance_arcsec2 = input.relock_variance_arcsec2,
        .half_excess_arcsec = input.half_excess_arcsec,
        .sign = input.sign,
        .measured = input.measured,
        .with_phase = input.with_phase};
    state.relock_to_come_arcsec2 = input.relock_to_come_arcsec2;
    state.bias_arcsec = input.bias_arcsec;
    if (input.measured) {
        state.common_arcsec2 = input.common_arcsec2;
        add_measured_tick(config, state, input, tick);
    } else {
        state.walk_of_switch_arcsec2 = input.walk_of_switch_arcsec2;
        add_gap_tick(gyro, config, state, input, tick);
    }

    sample.dtheta_arcsec = entry.row.dtheta_arcsec;
    sample.flags = entry.row.flags;
    if (tick - state.next_final >= final_delay_ticks(config)) {
        sample.has_final = true;
        sample.final_row = at(state, state.next_final++).row;
    }
    if (!is_estimated(config)) return sample;
    if (sample.has_final) hold_apart(gyro, state, tick - sample.final_row.tick, sample.final_row);
    learn(gyro, config, state, input, !resolved && !state.gap.open && state.n_pending == 0);
    if (state.n_pending > 0 && !resolved) advance_estimate(gyro, config, state);
    return sample;
}

DrainOutput drain(const CompensationConstants& gyro, const GapBridgeConfig& config, GapBridgeState& state) noexcept {
    DrainOutput out;
    for (int k = 0; k < state.n_pending && !out.has_gap; ++k) {
        PendingGap& pending = state.pending[static_cast<unsigned>(k)];
        if (pending.resolved) continue;
        out.gap = resolve(gyro, config, state, pending, state.next_tick, all_work);
        out.has_gap = pending.gap.has_before;
    }
    // Every gap must be resolved before a row may leave.
    if (out.has_gap) return out;
    if (state.gap.open && config.method != BridgeMethod::none) {
        const std::int64_t first = state.gap.gap.first_tick;
        const std::int64_t kept = first > state.next_final ? first : state.next_final;
        (void)settle_known(gyro, config, state, state.gap.gap, kept, state.next_tick - 1, state.gap.constant_arcsec);
    }
    if (state.next_final < state.next_tick) {
        out.has_row = true;
        out.row = at(state, state.next_final++).row;
        if (is_estimated(config)) hold_apart(gyro, state, state.next_tick - state.next_final, out.row);
    }
    return out;
}

}  // namespace zlg::core
