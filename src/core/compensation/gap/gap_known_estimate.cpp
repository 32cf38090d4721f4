// The ticks of a gap of known sum, by the learnt motion: the estimate of `optimal_bridge`, with the sum as one more
// point.

#include <zlg/core/common/maths.hpp>
#include <zlg/core/compensation/cholesky.hpp>
#include <zlg/core/compensation/motion_learning.hpp>
#include <zlg/core/compensation/optimal_bridge.hpp>

#include "gap_estimate.hpp"
#include "gap_interpolation.hpp"
#include "gap_known.hpp"

namespace zlg::core {
namespace {

using FewColumn = ColumnOf<few_unknowns>;

constexpr int points_a_side_of_known = 3;

struct Problem {
    int n_gap = 0, n_side = 0;
    int n = 0;  // points, the sum among them
    std::array<int, few_unknowns> place{};
    FewColumn value{}, samples{};
    std::array<FewColumn, max_solved_gap> with_tick{};  // covariance of the points with each tick of the gap
    std::array<double, max_solved_gap> tick{};          // its variance
    CholeskyFactorOf<few_unknowns> factor{};
};

// The covariance of each tick with each point and with the sum.
void fill(const MotionCovariance& covariance, Problem& p) noexcept {
    const auto n_gap = static_cast<unsigned>(p.n_gap);
    const auto sum = static_cast<unsigned>(p.n);
    for (unsigned j = 0; j < n_gap; ++j) {
        const int own = p.n_side + static_cast<int>(j);
        for (unsigned k = 0; k < sum; ++k) p.with_tick[j][k] = covariance.of_ticks(p.place[k], own);
        p.tick[j] = covariance.of_ticks(own, own);
        p.with_tick[j][sum] += p.tick[j];
        for (unsigned i = 0; i < j; ++i) {
            const double between = covariance.of_ticks(p.n_side + static_cast<int>(i), own);
            p.with_tick[i][sum] += between;
            p.with_tick[j][sum] += between;
        }
    }
}

bool add_points(const MotionCovariance& covariance, const GapBridgeState& state, const Gap& gap, double level,
                Problem& p) noexcept {
    for (int k = 0; k < 2 * p.n_side; ++k) {
        const int place = place_of(k, p.n_side, p.n_gap);
        const std::int64_t tick = gap.first_tick - p.n_side + place;
        if (tick < 0 || tick >= state.next_tick - 1) continue;
        const HistoryTick& point = at(state, tick);
        if (point.row.tick != tick || !point.measured || !is_finite(point.variance_arcsec2)) continue;
        const auto n = static_cast<unsigned>(p.n);
        p.place[n] = place;
        p.value[n] = point.row.dtheta_final_arcsec - level;
        p.samples[n] = 1.0;
        FewColumn row{};
        for (unsigned i = 0; i <= n; ++i) row[i] = covariance.of_ticks(p.place[i], place);
        row[n] += point.relock_variance_arcsec2;
        if (!add_row(p.factor, row)) return false;
        ++p.n;
    }
    return p.n > 0;
}

// The sum, as the last point.
bool add_sum(double sum_arcsec, double error_arcsec2, Problem& p) noexcept {
    FewColumn row{};
    const auto last = static_cast<unsigned>(p.n);
    for (unsigned j = 0; j < static_cast<unsigned>(p.n_gap); ++j)
        for (unsigned k = 0; k <= last; ++k) row[k] += p.with_tick[j][k];
    row[last] += error_arcsec2;
    p.value[last] = sum_arcsec;
    p.samples[last] = p.n_gap;
    ++p.n;
    return add_row(p.factor, row);
}

void solve(const Problem& p, double level, double scale, KnownEstimate& out) noexcept {
    const FewColumn rate_column = forward(p.factor, p.samples);
    const double information = product(rate_column, rate_column, p.n);
    FewColumn rest = forward(p.factor, p.value);
    const double rate = product(rate_column, rest, p.n) / information;
    for (unsigned k = 0; k < static_cast<unsigned>(p.n); ++k) rest[k] -= rate * rate_column[k];
    const FewColumn dual = backward(p.factor, rest);
    const double misfit = inflation(scale, product(rest, rest, p.n) / (p.n - 1));
    const double sum_sq = rest[static_cast<unsigned>(p.n - 1)] * rest[static_cast<unsigned>(p.n - 1)];
    double sum_variance = 0.0;
    for (unsigned j = 0; j < static_cast<unsigned>(p.n_gap); ++j) {
        const FewColumn g = forward(p.factor, p.with_tick[j]);
        const double gain = (1.0 - product(g, rate_column, p.n)) / information;
        out.value_arcsec[j] = level + rate + product(p.with_tick[j], dual, p.n);
        out.variance_arcsec2[j] = misfit * (p.tick[j] - product(g, g, p.n) + gain * gain * information);
        const double by_points = p.tick[j] - product(g, g, p.n - 1);
        sum_variance += by_points;
    }
    // Variance of the sum by the points alone: at most n times the sum of the ticks' variances, because their errors
    // are correlated.
    const double beyond_points = sum_sq > outlier_sq ? sum_sq * sum_variance * p.n_gap : 0.0;
    const double w = 1.0 / p.n_gap;
    double outlier_variance = beyond_points * w * (1.0 - w);
    const double off_level = p.value[static_cast<unsigned>(p.n - 1)] * w;
    if (misfit > outlier_sq && off_level * off_level > outlier_variance) outlier_variance = off_level * off_level;
    for (unsigned j = 0; j < static_cast<unsigned>(p.n_gap); ++j) out.variance_arcsec2[j] += outlier_variance;
    out.known = true;
}

}  // namespace

double tick_variance(const CompensationConstants& gyro, const GapBridgeConfig& config, GapBridgeState& state) noexcept {
    if (!is_estimated(config) || !is_ready(config.optimal, state.learning)) return infinity;
    const MotionMemory memory = better_memory(state.learning.scores);
    const double scale = variance_ratio(state.learning.scores, memory);
    const MotionCovariance covariance{gyro,
                                      config.optimal,
                                      state.learning.moments,
                                      memory,
                                      scale > 1.0 ? scale : 1.0,
                                      state.learning.moments.with_phase};
    return covariance.of_ticks(0, 0);
}

KnownEstimate estimate_known(const CompensationConstants& gyro, const GapBridgeConfig& config, GapBridgeState& state,
                             const Gap& gap, double sum_arcsec, double error_arcsec2) noexcept {
    KnownEstimate out;
    if (!is_estimated(config) || !is_ready(config.optimal, state.learning)) return out;
    if (gap.n < 2 || gap.n > max_solved_gap) return out;
    const int n_gap = static_cast<int>(gap.n);
    const int room = points_a_side(n_gap);
    Problem p{.n_gap = n_gap, .n_side = room < points_a_side_of_known ? room : points_a_side_of_known};
    const MotionMemory memory = better_memory(state.learning.scores);
    const double scale = variance_ratio(state.learning.scores, memory);
    const MotionCovariance covariance{gyro,   config.optimal, state.learning.moments,
                                      memory, scale,          state.learning.moments.with_phase};
    const double level = state.learning.moments.level;
    if (!add_points(covariance, state, gap, level, p)) return out;
    fill(covariance, p);
    if (!add_sum(sum_arcsec - n_gap * level, error_arcsec2, p)) return out;
    solve(p, level, scale, out);
    return out;
}

}  // namespace zlg::core
