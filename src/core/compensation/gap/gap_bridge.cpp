#include <zlg/core/compensation/gap_bridge.hpp>

#include <algorithm>

#include <zlg/core/common/as_double.hpp>
#include <zlg/core/common/handover.hpp>
#include <zlg/core/common/maths.hpp>
#include <zlg/core/compensation/border.hpp>

#include "common/bounds.hpp"
#include "gap_interpolation.hpp"
#include "gap_known.hpp"
#include "gap_switch.hpp"

namespace zlg::core {
namespace {

// Eq (14) for the present gap; without a point before it there is none.
PolynomialFit extrapolation_of(const GapBridgeConfig& config, const GapBridgeState& state) noexcept {
    const Gap& gap = state.gap.gap;
    return fit_beside(state, gap, config.extrapolation_points, 0, gap.first_tick, order_of(config.method));
}

void begin_gap(const GapBridgeConfig& config, GapBridgeState& state, std::int64_t tick) noexcept {
    OpenGap& open = state.gap;
    open.open = true;
    open.gap.first_tick = tick;
    const PolynomialFit fit = extrapolation_of(config, state);
    if (fit.n() == 0) return;
    open.gap.has_before = true;
    open.gap.mode_before = at(state, tick - 1).row.mode;
    for (int k = 0; k < fit.n(); ++k)
        open.constant_arcsec += at(state, tick - 1 + fit.position(k)).row.dtheta_final_arcsec / fit.n();
}

// A row of a gap without an estimate.
void set_unrepaired(const OpenGap& open, AngleRow& row) noexcept {
    row.dtheta_final_arcsec = open.constant_arcsec;
    row.sigma_arcsec = infinity;
    row.flags |= flag_unrepaired;
}

// dtheta of the gap's tick j, and what its final value is if the log ends here.
void extrapolate(const CompensationConstants& gyro, const GapBridgeConfig& config, const GapBridgeState& state,
                 std::int32_t j, AngleRow& row) noexcept {
    const OpenGap& open = state.gap;
    row.flags |= flag_extrapolated;
    if (!open.gap.has_before || j > max_gap_ticks(config)) {
        row.dtheta_arcsec = open.constant_arcsec;
        return set_unrepaired(open, row);
    }
    const PolynomialFit fit = extrapolation_of(config, state);
    const PolynomialSum sum = sum_of(gyro, state, open.gap, fit, fit.weights(j));
    row.dtheta_arcsec = row.dtheta_final_arcsec = sum.value_arcsec;
    row.sigma_arcsec = deviation(sum.variance_arcsec2);
    if (fit.order() < order_of(config.method)) row.flags |= flag_lower_order;
}

// The gap has become too long. Only its first ticks were delivered with another than their final value, and they may
// have left the history before the gap ends.
void give_up(const GapBridgeConfig& config, GapBridgeState& state) noexcept {
    Gap& gap = state.gap.gap;
    ExactSum difference;
    for (int k = 0; k < max_gap_ticks(config); ++k) {
        AngleRow& row = at(state, gap.first_tick + k).row;
        set_unrepaired(state.gap, row);
        difference.add_difference(row.dtheta_final_arcsec, row.dtheta_arcsec);
    }
    gap.final_minus_delivered_arcsec = difference;
}

void add_gap_tick(const CompensationConstants& gyro, const GapBridgeConfig& config, GapBridgeState& state,
                  const TickInput& input, std::int64_t tick) noexcept {
    if (!state.gap.open) begin_gap(config, state, tick);
    Gap& gap = state.gap.gap;
    ++gap.n;
    gap.moves = gap.moves || (input.flags & flag_loop_unlocked) != 0;
    HistoryTick& entry = at(state, tick);
    if (gap.has_before && input.mode != gap.mode_before) entry.row.flags |= flag_switching;
    if (config.method == BridgeMethod::none) {
        entry.row.dtheta_arcsec = entry.row.dtheta_final_arcsec = input.value_arcsec;
        entry.row.sigma_arcsec = infinity;
        return;
    }
    const int longest = max_gap_ticks(config);
    const auto j = static_cast<std::int32_t>(gap.n <= longest ? gap.n : longest + 1);
    extrapolate(gyro, config, state, j, entry.row);
    note_known(rounding_arcsec2(gyro, state.with_phase), input, gap, entry);
    if (gap.n <= longest) return;
    // Its rows become final before its end is known.
    if (gap.n == longest + 1) give_up(config, state);
    const std::int64_t first = gap.n == longest + 1 ? gap.first_tick : tick;
    const ExactSum change =
        settle_known(gyro, config, state, gap, first, tick, state.gap.constant_arcsec).change_arcsec;
    gap.final_minus_delivered_arcsec.add(change);
}

// The first tick after a gap: from here on the gap waits.
void end_gap(const CompensationConstants& gyro, const GapBridgeConfig& config, GapBridgeState& state,
             const TickInput& input, std::int64_t tick) noexcept {
    const int wait = ticks_to_correction(gyro, config);
    const bool at_start = !state.gap.gap.has_before && config.extrapolation_points > wait;
    // There eq (14) is used in reversed time and needs its points after the gap.
    const int due = at_start ? config.extrapolation_points : wait;
    // A guard: no more gaps can end while one waits.
    if (state.n_pending < max_pending_gaps) {
        state.pending[static_cast<unsigned>(state.n_pending++)] = PendingGap{
            .gap = state.gap.gap,
            .due_tick = tick + due,
            .ready_before =
                static_cast<std::int16_t>(is_estimated(config) && !at_start ? due - ticks_to_last_point(config) : 0),
            .sign_after = input.sign,
            .mode_after = input.mode};
    }
    state.gap = OpenGap{};
}

// Variance of what the re-lock ticks add to the angle of a switch: the random walk, the corrections from tick `from`
// on, those after `end` as far as the last one tells, and all that is missing where nothing is subtracted.
double relock_beyond(const CompensationConstants& gyro, const GapBridgeConfig& config, const GapBridgeState& state,
                     const Gap& gap, std::int64_t from, std::int64_t end) noexcept {
    const std::int64_t first = gap.first_tick + gap.n;
    double sum = as_double(config.relock_ticks) * walk_arcsec2(gyro);
    for (std::int64_t tick = first; tick < end; ++tick) {
        const HistoryTick& entry = at(state, tick);
        const bool is_missing = config.relock == RelockMethod::none && (entry.row.flags & flag_relock_uncorrected) != 0;
        if (entry.read.measured && (tick >= from || is_missing)) sum += entry.read.relock_variance_arcsec2;
    }
    const std::int64_t to_come = first + config.relock_ticks - end;
    const HistoryTick& last = at(state, end - 1);
    if (to_come > 0 && (last.row.flags & flag_relock_corrected) != 0)
        sum += as_double(to_come) * last.read.relock_variance_arcsec2;
    return sum;
}

// Eq (15): give a gap its final rows by a polynomial, and its report their deviation.
//
// return  final minus delivered.
ExactSum interpolate(const CompensationConstants& gyro, const GapBridgeConfig& config, GapBridgeState& state,
                     const Gap& gap, std::int64_t end, GapReport& report) noexcept {
    const int order = order_of(config.method);
    // Through those after it alone in reversed time.
    const PolynomialFit fit = gap.has_before
                                  ? fit_beside(state, gap, config.points_before, config.points_after, end, order)
                                  : fit_beside(state, gap, 0, config.extrapolation_points, end, order);
    std::uint32_t gained = gap.has_before ? std::uint32_t{flag_interpolated} : 0u;
    // Also where the polynomial stands in for an estimate.
    if (is_estimated(config) || fit.order() < order) gained |= flag_lower_order;
    ExactSum difference;
    FitWeights of_angle{};
    for (std::int32_t j = 1; j <= gap.n; ++j) {
        const FitWeights weight = fit.weights(j);
        const PolynomialSum sum = sum_of(gyro, state, gap, fit, weight);
        for (std::size_t k = 0; k < weight.size(); ++k) of_angle[k] += weight[k];
        AngleRow& row = at(state, gap.first_tick + j - 1).row;
        row.dtheta_final_arcsec = sum.value_arcsec;
        row.sigma_arcsec = deviation(sum.variance_arcsec2);
        row.flags = (row.flags & ~(std::uint32_t{flag_unrepaired} | flag_lower_order)) | gained;
        if (!is_finite(row.sigma_arcsec)) row.flags |= flag_unrepaired;
        difference.add_difference(row.dtheta_final_arcsec, row.dtheta_arcsec);
    }
    double variance = sum_of(gyro, state, gap, fit, of_angle).variance_arcsec2;
    // The error of a re-lock correction is in the point, and stays in the angle behind the gap.
    for (int k = 0; k < fit.n(); ++k)
        if (fit.position(k) > gap.n)
            variance += (2.0 * of_angle[static_cast<unsigned>(k)] + 1.0) *
                        at(state, gap.first_tick - 1 + fit.position(k)).read.relock_variance_arcsec2;
    const std::int64_t behind = gap.first_tick + gap.n + config.points_after;
    report.sigma_sum_arcsec = deviation(variance + relock_beyond(gyro, config, state, gap, behind, end));
    return difference;
}

// An error that the points beside a gap have in common goes over to each of its ticks, and with those of the re-lock
// into the angle of the switch, all with one sign.
void widen_in_common(const GapBridgeConfig& config, GapBridgeState& state, const Gap& gap, GapReport& report) noexcept {
    for (std::int64_t j = 0; j < gap.n; ++j) {
        double& sigma = at(state, gap.first_tick + j).row.sigma_arcsec;
        sigma = square_root(sigma * sigma + state.common_arcsec2);
    }
    const double n_ticks = as_double(gap.n + config.relock_ticks);
    report.sigma_sum_arcsec = square_root(square(report.sigma_sum_arcsec) + n_ticks * n_ticks * state.common_arcsec2);
}

// Give a gap its final values from the ticks before `end`, its pending correction, eq (17), and its report.
//
// late    the estimate is recorded as not ready.
// return  false: its report goes to nobody.
bool resolve(const CompensationConstants& gyro, const GapBridgeConfig& config, GapBridgeState& state,
             PendingGap& pending, std::int64_t end, bool late, GapReport& report) noexcept {
    Gap& gap = pending.gap;
    pending.is_reported = true;
    report = {.first_tick = gap.first_tick,
              .n_ticks = gap.n,
              .sign_after = pending.sign_after,
              .mode_after = pending.mode_after,
              .mode_changed = pending.mode_after != gap.mode_before,
              .sigma_sum_arcsec = infinity};
    if (config.method == BridgeMethod::none) return gap.has_before;
    ExactSum difference = gap.final_minus_delivered_arcsec;
    const bool is_short = gap.n <= max_gap_ticks(config);
    std::int64_t behind = 0;  // the window of an estimate
    if (is_short) {
        const SwitchAngle found = take(gyro, state, pending, late);
        behind = found.behind;
        if (found.known && !gap.moves) gap.variance_arcsec2 = found.variance_arcsec2;
        difference = found.known ? found.gap_arcsec : interpolate(gyro, config, state, gap, end, report);
        if (found.known) report.sigma_sum_arcsec = deviation(found.variance_arcsec2);
        pending.correction_arcsec.add(found.after_arcsec);
        const KnownShift known =
            settle_known(gyro, config, state, gap, gap.first_tick, gap.first_tick + gap.n - 1, 0.0);
        difference.add(known.change_arcsec);
        if (known.variance_arcsec2 > 0.0)
            report.sigma_sum_arcsec = deviation(square(report.sigma_sum_arcsec) + known.variance_arcsec2);
    }
    if (is_known(gap))
        report.sigma_sum_arcsec = deviation(gap.known_variance_arcsec2);
    else if (is_short && state.common_arcsec2 > 0.0)
        widen_in_common(config, state, gap, report);
    report.dp_arcsec = -difference.value();
    pending.correction_arcsec.add(difference);
    // What the ticks behind the estimate add to the angle of the switch.
    if (behind > 0 && !is_known(gap))
        report.sigma_sum_arcsec =
            deviation(square(report.sigma_sum_arcsec) + relock_beyond(gyro, config, state, gap, behind, end));
    return gap.has_before;
}

// dtheta of a measured tick: its value, and the corrections of gaps that are due. Sums are exact, and the rounding
// residual goes into the next correction.
double deliver(const GapBridgeConfig& config, GapBridgeState& state, HistoryTick& entry, std::int64_t tick) noexcept {
    ExactSum sum = state.rounding_residual_arcsec;
    sum.add(entry.row.dtheta_final_arcsec);
    // Without a bridge only a late re-lock correction can be pending.
    bool is_correction = config.method != BridgeMethod::none;
    PendingGap* const first = state.pending.data();
    PendingGap* const last = first + state.n_pending;
    PendingGap* const kept = std::remove_if(first, last, [&](const PendingGap& pending) {
        if (pending.due_tick > tick) return false;
        sum.add(pending.correction_arcsec);
        is_correction = is_correction || pending.correction_arcsec != ExactSum{};
        return true;
    });
    if (kept == last) return entry.row.dtheta_final_arcsec;
    std::fill(kept, last, PendingGap{});
    state.n_pending = static_cast<int>(kept - first);
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
    entry.read.variance_arcsec2 += input.amend_variance_arcsec2;
    entry.read.relock_variance_arcsec2 += input.amend_variance_arcsec2;
    entry.row.sigma_arcsec = square_root(entry.read.variance_arcsec2);
    entry.row.flags |= input.amend_flags;
    // The tick was the first after the gap that ended last.
    if (state.n_pending == 0) return;
    PendingGap& pending = state.pending[static_cast<unsigned>(state.n_pending - 1)];
    pending.correction_arcsec.add_difference(entry.row.dtheta_final_arcsec, before_arcsec);
}

// Final values of the gaps whose last point is in, and the reports of those whose correction is due.
void resolve_due(const CompensationConstants& gyro, const GapBridgeConfig& config, GapBridgeState& state,
                 std::int64_t tick, bool late, AngleSample& sample) noexcept {
    for (int k = 0; k < state.n_pending; ++k) {
        PendingGap& pending = state.pending[static_cast<unsigned>(k)];
        if (pending.due_tick - pending.ready_before == tick) ask(gyro, config, state, pending, tick);
        if (pending.is_reported || pending.due_tick > tick) continue;
        GapReport report;
        if (!resolve(gyro, config, state, pending, tick, late, report)) continue;
        sample.has_gap = true;
        sample.gap = report;
    }
}

}  // namespace

AngleSample step(const CompensationConstants& gyro, const GapBridgeConfig& config, GapBridgeState& state,
                 const TickInput& input) noexcept {
    const std::int64_t tick = state.next_tick++;
    AngleSample sample{.tick = tick};
    if (input.amend_previous && tick > 0) amend_previous(state, input, tick);
    if (state.n_pending > 0) resolve_due(gyro, config, state, tick, input.late, sample);

    if (tick - state.next_final >= final_delay_ticks(gyro, config)) {
        sample.has_final = true;
        sample.final_row = at(state, state.next_final++).row;
    }
    HistoryTick& entry = at(state, tick);
    entry.read = input;
    entry.row = {.tick = tick, .relock_arcsec = input.relock_arcsec, .mode = input.mode, .flags = input.flags};
    entry.share = 0.0;
    entry.by_phase = state.with_phase;
    entry.known = {};
    if (input.measured) {
        state.common_arcsec2 = input.common_arcsec2;
        if (state.gap.open) end_gap(gyro, config, state, input, tick);
        entry.row.dtheta_final_arcsec = input.value_arcsec;
        entry.row.dtheta_arcsec = state.n_pending > 0 ? deliver(config, state, entry, tick) : input.value_arcsec;
        entry.row.sigma_arcsec = square_root(input.variance_arcsec2);
    } else {
        add_gap_tick(gyro, config, state, input, tick);
    }

    sample.dtheta_arcsec = entry.row.dtheta_arcsec;
    sample.flags = entry.row.flags;
    if (is_estimated(config)) {
        const auto& half = input.half;
        add(state.spread, is_settled(entry), half[0].angle_arcsec, half[1].angle_arcsec, forget_ticks);
        hand_over(state.background.n_ticks, static_cast<std::uint32_t>(state.next_tick));
        if (!state.background.worker.is_background) work(gyro, config, state);
    }
    return sample;
}

DrainOutput drain(const CompensationConstants& gyro, const GapBridgeConfig& config, GapBridgeState& state) noexcept {
    DrainOutput out;
    for (int k = 0; k < state.n_pending && !out.has_gap; ++k) {
        PendingGap& pending = state.pending[static_cast<unsigned>(k)];
        if (pending.is_reported) continue;
        if (pending.job < 0) ask(gyro, config, state, pending, state.next_tick);
        work(gyro, config, state);
        out.has_gap = resolve(gyro, config, state, pending, state.next_tick, false, out.gap);
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
    }
    return out;
}

}  // namespace zlg::core
