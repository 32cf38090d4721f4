#include "gap_interpolation.hpp"

#include <memory>

#include "common/pair.hpp"
#include "gap_estimate.hpp"

namespace zlg::core {
namespace {

constexpr std::array<double, max_gap_ticks> tick_numbers{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16};

// One point of a fit, as it enters the sums of a gap.
struct Point {
    PointWeight weight;
    double value_arcsec;
    double variance_arcsec2;
    double shared_arcsec2;  // with the point before it
};

// Add a point to the sums of one tick, or of a pair. Each tick adds up its points in their order, whatever stands beside
// it.
//
// return  the point's weight there.
template <class Number>
Number add(const Point& point, Number j, Number& value, Number& variance, Number& last_weight) noexcept {
    const Number w = point.weight.at(j);
    value += w * point.value_arcsec;
    variance += w * w * point.variance_arcsec2;
    variance -= point.shared_arcsec2 * w * last_weight;
    last_weight = w;
    return w;
}

// Add a few points to the sums of a gap: together, because the sums are then loaded and stored once.
template <std::size_t n_points>
void add(GapSums& sums, std::size_t n, const std::array<Point, n_points>& points) noexcept {
    std::array<double, n_points> sum{};
    std::size_t j = 0;
    for (; j + 1 < n; j += 2) {
        Pair value = load(sums.value_arcsec.data() + j);
        Pair variance = load(sums.variance_arcsec2.data() + j);
        Pair last = load(sums.last_weight.data() + j);
        for (std::size_t k = 0; k < n_points; ++k) {
            const Pair w = add(points[k], load(tick_numbers.data() + j), value, variance, last);
            sum[k] += w[0];
            sum[k] += w[1];
        }
        store(sums.value_arcsec.data() + j, value);
        store(sums.variance_arcsec2.data() + j, variance);
        store(sums.last_weight.data() + j, last);
    }
    for (std::size_t k = 0; k < n_points; ++k) {
        if (j < n)
            sum[k] +=
                add(points[k], tick_numbers[j], sums.value_arcsec[j], sums.variance_arcsec2[j], sums.last_weight[j]);
        sums.angle_variance_arcsec2 += sum[k] * sum[k] * points[k].variance_arcsec2;
        sums.angle_variance_arcsec2 -= points[k].shared_arcsec2 * sum[k] * sums.last_angle_weight;
        sums.last_angle_weight = sum[k];
    }
    sums.n_added += static_cast<int>(n_points);
}

Point point_of(const GapBridgeState& state, const GapSums& sums, int k, double shared_arcsec2) noexcept {
    const PolynomialFit& fit = sums.fit;
    const HistoryTick& tick = at(state, sums.first_tick - 1 + fit.position(k));
    return {.weight = fit.weight_of(static_cast<unsigned>(k)),
            .value_arcsec = tick.row.dtheta_final_arcsec,
            .variance_arcsec2 = tick.variance_arcsec2,
            .shared_arcsec2 = neighbours(fit, k) ? shared_arcsec2 : 0.0};
}

}  // namespace

// The same bits, so that a variance that is no number, of a tick of unknown variance, is equal to itself.
bool operator==(const GapSums& a, const GapSums& b) noexcept {
    for (unsigned j = 0; j < max_gap_ticks; ++j) {
        if (!same_bits(a.value_arcsec[j], b.value_arcsec[j])) return false;
        if (!same_bits(a.variance_arcsec2[j], b.variance_arcsec2[j])) return false;
        if (!same_bits(a.last_weight[j], b.last_weight[j])) return false;
    }
    return a.first_tick == b.first_tick && a.fit == b.fit && a.n_added == b.n_added &&
           same_bits(a.angle_variance_arcsec2, b.angle_variance_arcsec2) &&
           same_bits(a.last_angle_weight, b.last_angle_weight);
}

void Points::collect(const GapBridgeState& state, std::int64_t origin, int from, int to, std::int64_t end) noexcept {
    const int first = origin + from < 0 ? static_cast<int>(-origin) : from;
    const int last = origin + to < end ? to : static_cast<int>(end - 1 - origin);
    for (int x = first; x <= last; ++x) {
        // Written in any case, and kept where the tick counts.
        position[static_cast<unsigned>(n)] = x;
        if (at(state, origin + x).measured) ++n;
    }
}

void begin_sums(const GapBridgeConfig& config, const GapBridgeState& state, const Gap& gap, std::int64_t end, int order,
                GapSums& sums) noexcept {
    const int n = static_cast<int>(gap.n);
    const std::int64_t origin = gap.first_tick - 1;
    Points points;
    if (gap.has_before) {
        points.collect(state, origin, 1 - config.points_before, 0, end);
        points.collect(state, origin, n + 1, n + config.points_after, end);
    } else {
        points.collect(state, origin, n + 1, n + config.extrapolation_points, end);
    }
    sums.first_tick = gap.first_tick;
    std::construct_at(&sums.fit, points.position, points.n, order);
    sums.n_added = 0;
    sums.value_arcsec = {};
    sums.variance_arcsec2 = {};
    sums.last_weight = {};
    sums.angle_variance_arcsec2 = 0.0;
    sums.last_angle_weight = 0.0;
}

void add_points(const GapBridgeConfig& config, const GapBridgeState& state, const Gap& gap, int n_points,
                GapSums& sums) noexcept {
    const double shared = shared_rounding(config);
    const auto n = static_cast<std::size_t>(gap.n);
    const auto point = [&](int k) { return point_of(state, sums, sums.n_added + k, shared); };
    while (sums.n_added < n_points) {
        const int left = n_points - sums.n_added;
        if (left >= 4)
            add<4>(sums, n, {point(0), point(1), point(2), point(3)});
        else if (left >= 2)
            add<2>(sums, n, {point(0), point(1)});
        else
            add<1>(sums, n, {point(0)});
    }
}

namespace {

// How much of the next tick's work is done at the end of a tick, which has work of its own, at the end of one in a gap,
// which has more, and between two ticks: so that the dearest of these and of the next tick is cheap. Unit: a point.
constexpr int work_after_measured = 7;
constexpr int work_after_gap = 5;
constexpr int work_between = 10;

// A portion of the sums of a gap that is due in the next tick. The last point is left for that tick, which may still
// amend it.
//
// return  what is left of `work`.
int advance_sums(const GapBridgeConfig& config, const GapBridgeState& state, const Gap& gap, GapSums& sums,
                 int work) noexcept {
    constexpr int work_to_begin = 3;
    if (sums.first_tick != gap.first_tick) {
        if (work < work_to_begin) return 0;
        begin_sums(config, state, gap, state.next_tick, order_of(config.method), sums);
        work -= work_to_begin;
    }
    const int missing = sums.fit.n() - 1 - sums.n_added;
    const int n_points = missing < work ? missing : work;
    add_points(config, state, gap, sums.n_added + n_points, sums);
    return work - n_points;
}

void advance(const GapBridgeConfig& config, GapBridgeState& state, int work) noexcept {
    if (config.method == BridgeMethod::none) return;
    std::size_t n_due = 0;
    for (int k = 0; k < state.n_pending && n_due < state.sums.size(); ++k) {
        const PendingGap& pending = state.pending[static_cast<unsigned>(k)];
        if (pending.due_tick == state.next_tick && pending.gap.n <= max_gap_ticks)
            work = advance_sums(config, state, pending.gap, state.sums[n_due++], work);
    }
}

}  // namespace

void prepare_after(const GapBridgeConfig& config, GapBridgeState& state, bool measured) noexcept {
    if (is_estimated(config)) return advance_estimate(config, state);
    advance(config, state, measured ? work_after_measured : work_after_gap);
}

void prepare(const GapBridgeConfig& config, GapBridgeState& state) noexcept {
    if (is_estimated(config)) return prepare_estimate(config, state);
    advance(config, state, work_between);
}

}  // namespace zlg::core
