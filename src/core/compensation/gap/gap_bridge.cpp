#include <zlg/core/compensation/gap_bridge.hpp>

#include <memory>

#include <zlg/core/common/maths.hpp>

#include "few_ticks.hpp"
#include "gap_estimate.hpp"
#include "gap_interpolation.hpp"
#include "gap_known.hpp"

namespace zlg::core {
namespace {

void begin_gap(const GapBridgeConfig& config, GapBridgeState& state, std::int64_t tick) noexcept {
    OpenGap& open = state.gap;
    open.open = true;
    open.gap.first_tick = tick;
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

// A row of a gap that nothing better is known of.
void set_unrepaired(const OpenGap& open, AngleRow& row) noexcept {
    row.dtheta_final_arcsec = open.constant_arcsec;
    row.sigma_arcsec = infinity;
    row.flags |= flag_unrepaired;
}

// A row of a gap that is known from the ticks before it.
void set_known(AngleRow& row, double value_arcsec, double variance_arcsec2) noexcept {
    row.dtheta_arcsec = value_arcsec;
    row.dtheta_final_arcsec = value_arcsec;
    row.sigma_arcsec = deviation(variance_arcsec2);
}

// dtheta of the gap's tick j, and what its final value is if the log ends here.
void extrapolate(const GapBridgeConfig& config, const GapBridgeState& state, HistoryTick& entry,
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
        return set_known(row, predicted.value_arcsec[k], predicted.variance_arcsec2[k]);
    }
    const double shared = shared_rounding(config);
    const FitWeights w = open.fit.weights(j);
    double sum = 0.0;
    double variance = 0.0;
    for (unsigned k = 0; k < static_cast<unsigned>(open.fit.n()); ++k) {
        sum += w[k] * open.value_arcsec[k];
        variance += w[k] * w[k] * open.variance_arcsec2[k];
        if (neighbours(open.fit, static_cast<int>(k))) variance -= shared * w[k] * w[k - 1];
    }
    set_known(row, sum, variance);
    if (open.lower_order) row.flags |= flag_lower_order;
}

// The gap has become too long. Only its first ticks were delivered with something else than their final value, and the
// history may have forgotten them when it ends.
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

void take_gap_tick(const GapBridgeConfig& config, GapBridgeState& state, const TickInput& input,
                   std::int64_t tick) noexcept {
    if (!state.gap.open) {
        begin_gap(config, state, tick);
        if (is_estimated(config) && state.gap.gap.has_before) predict_gap(config, state, tick);
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
    extrapolate(config, state, entry, j);
    note_known(config, input, gap, entry);
    if (gap.n <= max_gap_ticks) return;
    // Its rows leave before its end is known.
    if (gap.n == max_gap_ticks + 1) give_up(state);
    const std::int64_t first = gap.n == max_gap_ticks + 1 ? gap.first_tick : tick;
    const ExactSum change = settle_known(config, state, gap, first, tick, state.gap.constant_arcsec);
    gap.final_minus_delivered_arcsec.add(change.high);
    gap.final_minus_delivered_arcsec.add(change.low);
}

// The first tick after a gap: from here on the gap waits.
void end_gap(const GapBridgeConfig& config, GapBridgeState& state, const TickInput& input, std::int64_t tick) noexcept {
    const bool at_start = !state.gap.gap.has_before && config.extrapolation_points > ticks_to_correction(config);
    const int wait = at_start ? config.extrapolation_points : ticks_to_correction(config);
    if (state.n_pending < max_pending_gaps) {
        state.pending[static_cast<unsigned>(state.n_pending++)] = PendingGap{
            .gap = state.gap.gap, .due_tick = tick + wait, .sign_after = input.sign, .mode_after = input.mode};
    }
    state.gap = OpenGap{};
}

// Give a gap its final rows.
//
// more_arcsec2  variance of each that the fit does not know of.
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
        difference.add(row.dtheta_final_arcsec);
        difference.add(-row.dtheta_arcsec);
    }
    return difference;
}

// Give a gap its final rows by a polynomial, and its report their deviation.
//
// return  final minus delivered.
ExactSum fit(const GapBridgeConfig& config, GapBridgeState& state, const Gap& gap, std::int64_t end,
             const EstimatedAngle& found, GapReport& report) noexcept {
    GapSums sums = sums_of(config, state, gap, end, found.order);
    const bool in_place = is_estimated(config) && !found.has_history;
    if (in_place && config.optimal.learns) {
        const FewTicks few = judge_by_few(config, state, gap, end, sums.fit, sums.value_arcsec);
        if (few.known) {
            sums.variance_arcsec2 = few.variance_arcsec2;
            sums.angle_variance_arcsec2 = few.sum_variance_arcsec2;
        }
    }
    const double judged = found.polynomial_variance_arcsec2;
    const double variance = sums.angle_variance_arcsec2;
    report.sigma_sum_arcsec = deviation(judged > 0.0 ? judged : variance);
    const auto n = static_cast<double>(gap.n);
    const double more = variance < judged ? (judged - variance) / (n * n) : 0.0;
    return interpolate(state, gap, sums, in_place || sums.fit.order() < found.order, more);
}

// In the tick that needs it, of what an estimate has left to do; and at the end of a log, where time does not matter.
constexpr int last_work = 6;
constexpr int all_work = 1000;

// Give a gap its final values from the ticks before `end`, and its lump.
GapReport resolve(const GapBridgeConfig& config, GapBridgeState& state, PendingGap& pending, std::int64_t end,
                  int work) noexcept {
    const Gap& gap = pending.gap;
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
        const EstimatedAngle found = is_estimated(config) ? estimate(config, state, gap, end, work)
                                                          : EstimatedAngle{.order = order_of(config.method)};
        difference = found.known ? found.gap_arcsec : fit(config, state, gap, end, found, report);
        if (found.known) report.sigma_sum_arcsec = found.sigma_sum_arcsec;
        pending.lump_arcsec.add(found.after_arcsec.high);
        pending.lump_arcsec.add(found.after_arcsec.low);
        const ExactSum change = settle_known(config, state, gap, gap.first_tick, gap.first_tick + gap.n - 1, 0.0);
        difference.add(change.high);
        difference.add(change.low);
    }
    if (is_known(gap)) report.sigma_sum_arcsec = deviation(gap.known_variance_arcsec2);
    report.dp_arcsec = -difference.value();
    pending.lump_arcsec.add(difference.high);
    pending.lump_arcsec.add(difference.low);
    return report;
}

// dtheta of a measured tick: its value, and the lumps that are due.
double deliver(const GapBridgeConfig& config, GapBridgeState& state, HistoryTick& entry, std::int64_t tick) noexcept {
    ExactSum sum = state.carry_arcsec;
    sum.add(entry.row.dtheta_final_arcsec);
    int kept = 0;
    // Where nothing is bridged only a late re-lock correction can be owed.
    bool owed = config.method != BridgeMethod::none;
    for (int k = 0; k < state.n_pending; ++k) {
        const PendingGap& pending = state.pending[static_cast<unsigned>(k)];
        if (pending.due_tick > tick) {
            if (kept != k) state.pending[static_cast<unsigned>(kept)] = pending;
            ++kept;
            continue;
        }
        sum.add(pending.lump_arcsec.high);
        sum.add(pending.lump_arcsec.low);
        owed = owed || pending.lump_arcsec != ExactSum{};
    }
    if (kept == state.n_pending) return entry.row.dtheta_final_arcsec;
    for (int k = kept; k < state.n_pending; ++k) state.pending[static_cast<unsigned>(k)] = PendingGap{};
    state.n_pending = kept;
    if (!owed) return entry.row.dtheta_final_arcsec;
    entry.row.flags |= flag_correction;
    const double delivered = sum.value();
    sum.add(-delivered);
    state.carry_arcsec = sum;
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
        pending.lump_arcsec.add(entry.row.dtheta_final_arcsec);
        pending.lump_arcsec.add(-before_arcsec);
    }
}

void take_measured_tick(const GapBridgeConfig& config, GapBridgeState& state, const TickInput& input,
                        std::int64_t tick) noexcept {
    if (state.gap.open) end_gap(config, state, input, tick);
    HistoryTick& entry = at(state, tick);
    entry.row.dtheta_final_arcsec = input.value_arcsec;
    entry.row.dtheta_arcsec = state.n_pending > 0 ? deliver(config, state, entry, tick) : input.value_arcsec;
    entry.row.sigma_arcsec = square_root(input.variance_arcsec2);
}

// return  some gap was due.
bool resolve_due(const GapBridgeConfig& config, GapBridgeState& state, std::int64_t tick,
                 AngleSample& sample) noexcept {
    bool any = false;
    for (int k = 0; k < state.n_pending; ++k) {
        PendingGap& pending = state.pending[static_cast<unsigned>(k)];
        if (pending.resolved || pending.due_tick > tick) continue;
        any = true;
        const GapReport report = resolve(config, state, pending, tick, last_work);
        if (!pending.gap.has_before) continue;
        sample.has_gap = true;
        sample.gap = report;
    }
    return any;
}

}  // namespace

AngleSample step(const GapBridgeConfig& config, GapBridgeState& state, const TickInput& input) noexcept {
    const std::int64_t tick = state.next_tick++;
    AngleSample sample{.tick = tick};
    if (input.amend_previous && tick > 0) amend_previous(state, input, tick);
    const bool resolved = state.n_pending > 0 && resolve_due(config, state, tick, sample);

    HistoryTick& entry = at(state, tick);
    entry = HistoryTick{
        .row = {.tick = tick, .relock_arcsec = input.relock_arcsec, .mode = input.mode, .flags = input.flags},
        .variance_arcsec2 = input.variance_arcsec2,
        .relock_variance_arcsec2 = input.relock_variance_arcsec2,
        .half_excess_arcsec = input.half_excess_arcsec,
        .sign = input.sign,
        .measured = input.measured};
    state.bias_arcsec = input.bias_arcsec;
    if (input.measured)
        take_measured_tick(config, state, input, tick);
    else
        take_gap_tick(config, state, input, tick);

    sample.dtheta_arcsec = entry.row.dtheta_arcsec;
    sample.flags = entry.row.flags;
    if (tick - state.next_final >= final_delay_ticks(config)) {
        sample.has_final = true;
        sample.final_row = at(state, state.next_final++).row;
    }
    if (!is_estimated(config)) return sample;
    learn(config, state, input, !resolved && !state.gap.open && state.n_pending == 0);
    if (state.n_pending > 0 && !resolved) advance_estimate(config, state);
    return sample;
}

DrainOutput drain(const GapBridgeConfig& config, GapBridgeState& state) noexcept {
    DrainOutput out;
    for (int k = 0; k < state.n_pending && !out.has_gap; ++k) {
        PendingGap& pending = state.pending[static_cast<unsigned>(k)];
        if (pending.resolved) continue;
        out.gap = resolve(config, state, pending, state.next_tick, all_work);
        out.has_gap = pending.gap.has_before;
    }
    // Every gap must be resolved before a row may leave.
    if (out.has_gap) return out;
    if (state.gap.open && config.method != BridgeMethod::none) {
        const std::int64_t first = state.gap.gap.first_tick;
        const std::int64_t kept = first > state.next_final ? first : state.next_final;
        (void)settle_known(config, state, state.gap.gap, kept, state.next_tick - 1, state.gap.constant_arcsec);
    }
    if (state.next_final < state.next_tick) {
        out.has_row = true;
        out.row = at(state, state.next_final++).row;
    }
    return out;
}

}  // namespace zlg::core
