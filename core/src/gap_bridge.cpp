#include <zlg/core/gap_bridge.hpp>

#include <zlg/core/maths.hpp>

namespace zlg::core {
namespace {

HistoryTick& at(GapBridgeState& state, std::int64_t tick) noexcept {
    return state.history[static_cast<std::uint64_t>(tick) % history_ticks];
}

const HistoryTick& at(const GapBridgeState& state, std::int64_t tick) noexcept {
    return state.history[static_cast<std::uint64_t>(tick) % history_ticks];
}

// The measured ticks among some standard positions, counted from the tick before a gap.
struct Points {
    int n = 0;
    std::array<std::int32_t, max_fit_points> position{};
    std::array<double, max_fit_points> value_arcsec{};

    // Positions from..to that lie before tick `end` and were measured.
    void collect(const GapBridgeState& state, std::int64_t origin, int from, int to, std::int64_t end) noexcept {
        for (int x = from; x <= to; ++x) {
            const std::int64_t tick = origin + x;
            if (tick < 0 || tick >= end || !at(state, tick).measured) continue;
            position[static_cast<unsigned>(n)] = x;
            value_arcsec[static_cast<unsigned>(n)] = at(state, tick).row.dtheta_final_arcsec;
            ++n;
        }
    }
};

template <std::size_t size>
double weighted(const FitWeights& w, const std::array<double, size>& value, int n) noexcept {
    double sum = 0.0;
    for (unsigned k = 0; k < static_cast<unsigned>(n); ++k) sum += w[k] * value[k];
    return sum;
}

// Standard deviation of a weighted sum of ticks. The rounding of one counter reading enters two neighbouring ticks with
// opposite signs: their covariance is -count^2/12.
double sigma_of(const GapBridgeConfig& config, const GapBridgeState& state, const PolynomialFit& fit,
                std::int64_t origin, const FitWeights& w) noexcept {
    const double shared = config.count.value() * config.count.value() / 6.0;
    double variance = 0.0;
    for (int k = 0; k < fit.n(); ++k) {
        const double wk = w[static_cast<unsigned>(k)];
        variance += wk * wk * at(state, origin + fit.position(k)).variance_arcsec2;
        if (k > 0 && fit.position(k) == fit.position(k - 1) + 1)
            variance -= shared * wk * w[static_cast<unsigned>(k - 1)];
    }
    return variance >= 0.0 ? square_root(variance) : infinity;
}

void begin_gap(const GapBridgeConfig& config, GapBridgeState& state, std::int64_t tick) noexcept {
    OpenGap gap{.open = true, .first_tick = tick};
    Points points;
    points.collect(state, tick - 1, 1 - config.extrapolation_points, 0, tick);
    if (points.n > 0) {
        gap.has_before = true;
        gap.mode_before = at(state, tick - 1).row.mode;
        gap.fit = PolynomialFit{points.position, points.n, order_of(config.method)};
        gap.lower_order = gap.fit.order() < order_of(config.method);
        for (unsigned k = 0; k < static_cast<unsigned>(points.n); ++k) {
            gap.value_arcsec[k] = points.value_arcsec[k];
            gap.constant_arcsec += points.value_arcsec[k] / points.n;
        }
    }
    state.gap = gap;
}

// A row of a gap that nothing better is known of.
void set_unrepaired(const OpenGap& gap, AngleRow& row) noexcept {
    row.dtheta_final_arcsec = gap.constant_arcsec;
    row.sigma_arcsec = infinity;
    row.flags |= flag_unrepaired;
}

// dtheta of the gap's tick j, and what its final value is if the log ends here.
void extrapolate(const GapBridgeConfig& config, GapBridgeState& state, HistoryTick& entry, std::int32_t j) noexcept {
    const OpenGap& gap = state.gap;
    AngleRow& row = entry.row;
    row.flags |= flag_extrapolated;
    if (!gap.has_before || j > max_gap_ticks) {
        row.dtheta_arcsec = gap.constant_arcsec;
        return set_unrepaired(gap, row);
    }
    const FitWeights w = gap.fit.weights(j);
    row.dtheta_arcsec = weighted(w, gap.value_arcsec, gap.fit.n());
    row.dtheta_final_arcsec = row.dtheta_arcsec;
    row.sigma_arcsec = sigma_of(config, state, gap.fit, gap.first_tick - 1, w);
    if (gap.lower_order) row.flags |= flag_lower_order;
}

// final minus delivered, over the first n ticks of a gap.
ExactSum final_minus_delivered(const GapBridgeState& state, const OpenGap& gap, int n) noexcept {
    ExactSum sum;
    for (int k = 0; k < n; ++k) {
        const AngleRow& row = at(state, gap.first_tick + k).row;
        sum.add(row.dtheta_final_arcsec);
        sum.add(-row.dtheta_arcsec);
    }
    return sum;
}

// The gap has become too long. Only its first ticks were delivered with something else than their final value, and the
// history may have forgotten them when it ends.
void give_up(GapBridgeState& state) noexcept {
    OpenGap& gap = state.gap;
    for (int k = 0; k < max_gap_ticks; ++k) set_unrepaired(gap, at(state, gap.first_tick + k).row);
    gap.final_minus_delivered_arcsec = final_minus_delivered(state, gap, max_gap_ticks);
}

void take_gap_tick(const GapBridgeConfig& config, GapBridgeState& state, const TickInput& input,
                   std::int64_t tick) noexcept {
    if (!state.gap.open) begin_gap(config, state, tick);
    OpenGap& gap = state.gap;
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
    if (gap.n == max_gap_ticks + 1) give_up(state);
}

// The first tick after a gap: from here on the gap waits.
void end_gap(const GapBridgeConfig& config, GapBridgeState& state, const TickInput& input, std::int64_t tick) noexcept {
    const bool at_start = !state.gap.has_before && config.extrapolation_points > config.points_after;
    const int wait = at_start ? config.extrapolation_points : config.points_after;
    if (state.n_pending < max_pending_gaps) {
        state.pending[static_cast<unsigned>(state.n_pending++)] =
            PendingGap{.gap = state.gap, .due_tick = tick + wait, .sign_after = input.sign, .mode_after = input.mode};
    }
    state.gap = OpenGap{};
}

// Write the final rows of a gap by a fit, and add up the weights of its sum.
FitWeights interpolate(const GapBridgeConfig& config, GapBridgeState& state, const OpenGap& gap, const Points& points,
                       const PolynomialFit& fit) noexcept {
    FitWeights sum{};
    for (std::int32_t j = 1; j <= static_cast<std::int32_t>(gap.n); ++j) {
        const FitWeights w = fit.weights(j);
        for (unsigned k = 0; k < static_cast<unsigned>(fit.n()); ++k) sum[k] += w[k];
        AngleRow& row = at(state, gap.first_tick + j - 1).row;
        row.dtheta_final_arcsec = weighted(w, points.value_arcsec, points.n);
        row.sigma_arcsec = sigma_of(config, state, fit, gap.first_tick - 1, w);
        row.flags &= ~(std::uint32_t{flag_unrepaired} | flag_lower_order);
        if (gap.has_before) row.flags |= flag_interpolated;
        if (fit.order() < order_of(config.method)) row.flags |= flag_lower_order;
    }
    return sum;
}

double repair(const GapBridgeConfig& config, GapBridgeState& state, const OpenGap& gap, std::int64_t end) noexcept {
    const int n = static_cast<int>(gap.n);
    const std::int64_t origin = gap.first_tick - 1;
    Points points;
    if (gap.has_before) {
        points.collect(state, origin, 1 - config.points_before, 0, end);
        points.collect(state, origin, n + 1, n + config.points_after, end);
    } else {
        points.collect(state, origin, n + 1, n + config.extrapolation_points, end);
    }
    const PolynomialFit fit{points.position, points.n, order_of(config.method)};
    return sigma_of(config, state, fit, origin, interpolate(config, state, gap, points, fit));
}

// Give a gap its final values from the ticks before `end`, and its lump.
GapReport resolve(const GapBridgeConfig& config, GapBridgeState& state, PendingGap& pending,
                  std::int64_t end) noexcept {
    const OpenGap& gap = pending.gap;
    GapReport report{.first_tick = gap.first_tick,
                     .n_ticks = gap.n,
                     .sign_after = pending.sign_after,
                     .mode_after = pending.mode_after,
                     .mode_changed = pending.mode_after != gap.mode_before,
                     .sigma_sum_arcsec = infinity};
    pending.resolved = true;
    if (config.method == BridgeMethod::none) return report;
    if (gap.n <= max_gap_ticks) report.sigma_sum_arcsec = repair(config, state, gap, end);
    const ExactSum difference = gap.n <= max_gap_ticks ? final_minus_delivered(state, gap, static_cast<int>(gap.n))
                                                       : gap.final_minus_delivered_arcsec;
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

}  // namespace

AngleSample step(const GapBridgeConfig& config, GapBridgeState& state, const TickInput& input) noexcept {
    const std::int64_t tick = state.next_tick++;
    AngleSample sample{.tick = tick};
    if (input.amend_previous && tick > 0) amend_previous(state, input, tick);
    for (int k = 0; k < state.n_pending; ++k) {
        PendingGap& pending = state.pending[static_cast<unsigned>(k)];
        if (pending.resolved || pending.due_tick > tick) continue;
        const GapReport report = resolve(config, state, pending, tick);
        if (!pending.gap.has_before) continue;
        sample.has_gap = true;
        sample.gap = report;
    }

    HistoryTick& entry = at(state, tick);
    entry = HistoryTick{
        .row = {.tick = tick, .relock_arcsec = input.relock_arcsec, .mode = input.mode, .flags = input.flags},
        .variance_arcsec2 = input.variance_arcsec2,
        .measured = input.measured};
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
    return sample;
}

DrainOutput drain(const GapBridgeConfig& config, GapBridgeState& state) noexcept {
    DrainOutput out;
    for (int k = 0; k < state.n_pending && !out.has_gap; ++k) {
        PendingGap& pending = state.pending[static_cast<unsigned>(k)];
        if (pending.resolved) continue;
        out.gap = resolve(config, state, pending, state.next_tick);
        out.has_gap = pending.gap.has_before;
    }
    // Every gap must be resolved before a row may leave.
    if (out.has_gap) return out;
    if (state.next_final < state.next_tick) {
        out.has_row = true;
        out.row = at(state, state.next_final++).row;
    }
    return out;
}

}  // namespace zlg::core
