#include <zlg/core/compensation/optimal_bridge.hpp>

#include <zlg/core/common/maths.hpp>

namespace zlg::core {
namespace {

template <std::size_t capacity>
int stride_of(const GapProblemOf<capacity>& problem) noexcept {
    return problem.halves ? 2 : 1;
}

template <std::size_t capacity>
double covariance_of(const MotionCovariance& covariance, const GapProblemOf<capacity>& problem, int a, int b) noexcept {
    return problem.halves ? covariance.of_samples(a, b) : covariance.of_ticks(a, b);
}

template <std::size_t capacity>
void subtract(ColumnOf<capacity>& from, double factor, const ColumnOf<capacity>& x, int n) noexcept {
#pragma GCC unroll 4
    for (unsigned k = 0; k < static_cast<unsigned>(n); ++k) from[k] -= factor * x[k];
}

// Project the nuisances out of L^-1 x.
template <std::size_t capacity>
void project_out(const GapRatesOf<capacity>& rates, ColumnOf<capacity>& x, int n) noexcept {
    for (unsigned k = 0; k < static_cast<unsigned>(rates.n_nuisances); ++k)
        subtract(x, product(rates.nuisance[k], x, n), rates.nuisance[k], n);
}

// Add a nuisance x, a column of H: its image L^-1 x, made orthogonal to the earlier ones and of norm 1.
template <std::size_t capacity>
void add_nuisance(const GapProblemOf<capacity>& problem, const ColumnOf<capacity>& x,
                  GapRatesOf<capacity>& rates) noexcept {
    const int n = problem.factor.n;
    ColumnOf<capacity> column = forward(problem.factor, x);
    project_out(rates, column, n);
    const double norm = product(column, column, n);
    if (!(norm > 0.0)) return;
    const double scale = 1.0 / square_root(norm);
    for (double& value : column) value *= scale;
    rates.nuisance[static_cast<unsigned>(rates.n_nuisances++)] = column;
}

// A column that has one value before the gap and one after it.
template <std::size_t capacity>
ColumnOf<capacity> by_side(const GapProblemOf<capacity>& problem, double before, double after,
                           bool alternating) noexcept {
    const int start = stride_of(problem) * problem.n_side;
    ColumnOf<capacity> column{};
    for (unsigned k = 0; k < static_cast<unsigned>(problem.factor.n); ++k) {
        const double value = problem.place[k] >= start ? after : before;
        column[k] = alternating && problem.place[k] % 2 != 0 ? -value : value;
    }
    return column;
}

// L^-1 H and the information of the rate. With the factor C + E = L L^T all of (2)-(4) become products of the columns
// L^-1 x: x^T V y = (L^-1 x)^T (L^-1 y), and P is the projection that removes the columns of L^-1 H.
template <std::size_t capacity>
GapRatesOf<capacity> rates_of(const GapProblemOf<capacity>& problem) noexcept {
    const int n = problem.factor.n;
    GapRatesOf<capacity> rates;
    if (problem.halves) {
        add_nuisance(problem, by_side(problem, 1.0, 0.0, true), rates);
        add_nuisance(problem, by_side(problem, 0.0, 1.0, true), rates);
    }
    rates.rate = forward(problem.factor, by_side(problem, 1.0, 1.0, false));
    project_out(rates, rates.rate, n);
    rates.information = product(rates.rate, rates.rate, n);
    return rates;
}

// k = cov(z, tau) for the sum of n ticks of the gap, from tick `first` on.
template <std::size_t capacity>
ColumnOf<capacity> with_gap(const MotionCovariance& covariance, const GapProblemOf<capacity>& problem, int first,
                            int n) noexcept {
    const int stride = stride_of(problem);
    const int from = stride * (problem.n_side + first);
    ColumnOf<capacity> k{};
    for (unsigned i = 0; i < static_cast<unsigned>(problem.factor.n); ++i)
        for (int s = from; s < from + stride * n; ++s) k[i] += covariance_of(covariance, problem, problem.place[i], s);
    return k;
}

// v = var(tau) of the same sum.
template <std::size_t capacity>
double variance_in_gap(const MotionCovariance& covariance, const GapProblemOf<capacity>& problem, int first,
                       int n) noexcept {
    double sum = 0.0;
    for (int a = problem.n_side + first; a < problem.n_side + first + n; ++a) {
        sum += covariance.of_ticks(a, a);
        for (int b = problem.n_side + first; b < a; ++b) sum += 2.0 * covariance.of_ticks(b, a);
    }
    return sum;
}

// One quantity to be estimated.
template <std::size_t capacity>
struct TargetOf {
    ColumnOf<capacity> g{};  // L^-1 k, the nuisances projected out
    double rate_gain = 0.0;  // (h - H^T V k)/(H^T V H) of the rate
    double variance = 0.0;   // (4)
};

// (4) for one target.
//
// with_points  k.
// variance     v.
// samples      h of the rate: samples of the gap in the target.
template <std::size_t capacity>
TargetOf<capacity> target_of(const GapProblemOf<capacity>& problem, const GapRatesOf<capacity>& rates,
                             const ColumnOf<capacity>& with_points, double variance, double samples) noexcept {
    const int n = problem.factor.n;
    TargetOf<capacity> t{.g = forward(problem.factor, with_points)};
    project_out(rates, t.g, n);
    t.rate_gain = (samples - product(t.g, rates.rate, n)) / rates.information;
    t.variance = variance - product(t.g, t.g, n) + t.rate_gain * t.rate_gain * rates.information;
    return t;
}

template <std::size_t capacity>
bool is_solvable(const GapProblemOf<capacity>& problem, const GapRatesOf<capacity>& rates) noexcept {
    return !problem.failed && problem.factor.n > rates.n_nuisances + 1 && rates.information > 0.0;
}

// Stage 1: the rate b^ by generalised least squares, the dual u = P z and the innovation z^T P z.
template <std::size_t capacity>
void solve_points(const GapProblemOf<capacity>& problem, const GapDataOf<capacity>& data,
                  GapSolutionOf<capacity>& s) noexcept {
    const int n = problem.factor.n;
    ColumnOf<capacity> rest = forward(problem.factor, data.value);
    project_out(s.rates, rest, n);
    s.rate = product(s.rates.rate, rest, n) / s.rates.information;
    subtract(rest, s.rate, s.rates.rate, n);
    s.estimate.innovation_ratio = product(rest, rest, n) / (n - s.rates.n_nuisances - 1);
    s.estimate.dual = backward(problem.factor, rest);
    for (unsigned k = 0; k < static_cast<unsigned>(n); ++k) s.with_sum[k] = -data.error_with_all[k];
}

// How the estimate of tick j of the gap weighs the roundings of the readings: point k is the difference of two.
template <std::size_t capacity>
void weigh_borders(const GapProblemOf<capacity>& problem, const TargetOf<capacity>& t, int j,
                   GapSolutionOf<capacity>& s) noexcept {
    const auto n = static_cast<unsigned>(problem.factor.n);
    const int start = stride_of(problem) * (problem.n_side + j);
    ColumnOf<capacity> g = t.g;
    subtract(g, -t.rate_gain, s.rates.rate, problem.factor.n);
    const ColumnOf<capacity> weight = backward(problem.factor, g);
    double sum = weight[0] * weight[0];
    double at_edges = 0.0;
    for (unsigned k = 0; k < n; ++k) {
        const bool is_next = k + 1 < n && problem.place[k + 1] == problem.place[k] + 1;
        const double step = is_next ? weight[k + 1] - weight[k] : weight[k];
        sum += step * step;
        // Not the neighbour of another point: one more border.
        if (!is_next && k + 1 < n) sum += weight[k + 1] * weight[k + 1];
        const int from = problem.place[k] - start;
        if (from == -1 || from == stride_of(problem)) at_edges += weight[k];
        // A lit half of the tick itself.
        if (from == 0 || from == stride_of(problem) - 1) at_edges -= weight[k];
    }
    s.estimate.border_weight_sq[static_cast<unsigned>(j)] = sum;
    s.estimate.edge_weight[static_cast<unsigned>(j)] = at_edges;
}

// Stages 2..: tick j of the gap, (3) and (4).
template <std::size_t capacity>
void solve_tick(const MotionCovariance& covariance, const GapProblemOf<capacity>& problem,
                const GapDataOf<capacity>& data, int j, GapSolutionOf<capacity>& s) noexcept {
    const int n = problem.factor.n;
    const int stride = stride_of(problem);
    const ColumnOf<capacity> with_points = with_gap(covariance, problem, j, 1);
    const TargetOf<capacity> t =
        target_of(problem, s.rates, with_points, variance_in_gap(covariance, problem, j, 1), stride);
    subtract(s.with_sum, -1.0, with_points, n);
    s.estimate.value_arcsec[static_cast<unsigned>(j)] =
        data.level + stride * s.rate + product(with_points, s.estimate.dual, n);
    s.estimate.variance_arcsec2[static_cast<unsigned>(j)] = t.variance;
    if constexpr (capacity == max_unknowns) weigh_borders(problem, t, j, s);
}

// The whole switch, sum of the ticks less the sum of the errors e: its variance, and its weights V (k + H rate_gain).
template <std::size_t capacity>
void solve_sum(const MotionCovariance& covariance, const GapProblemOf<capacity>& problem,
               const GapDataOf<capacity>& data, GapSolutionOf<capacity>& s) noexcept {
    const double variance = variance_in_gap(covariance, problem, 0, problem.n_gap) + data.error_variance;
    const double samples = stride_of(problem) * problem.n_gap;
    TargetOf<capacity> t = target_of(problem, s.rates, s.with_sum, variance, samples);
    s.estimate.sum_variance_arcsec2 = t.variance;
    subtract(t.g, -t.rate_gain, s.rates.rate, problem.factor.n);
    s.estimate.sum_weight = backward(problem.factor, t.g);
}

// Last stage: p^T P z and p^T P p of the probe p, from which an unknown factor of the errors is estimated.
template <std::size_t capacity>
void solve_probe(const GapProblemOf<capacity>& problem, const GapDataOf<capacity>& data,
                 GapSolutionOf<capacity>& s) noexcept {
    const int n = problem.factor.n;
    GapEstimateOf<capacity>& e = s.estimate;
    e.probe_dual = product(data.probe, e.dual, n);
    if (product(data.probe, data.probe, n) > 0.0)
        e.probe_information = -target_of(problem, s.rates, data.probe, 0.0, 0.0).variance;
    e.known = is_finite(e.sum_variance_arcsec2) && is_finite(product(e.dual, e.dual, n));
    s.done = true;
}

}  // namespace

OptimalBridgeFault check(const OptimalBridgeConfig& c) noexcept {
    if (!c.learns) {
        if (!(c.prior_arcsec2[0] > 0.0)) return OptimalBridgeFault::prior;
        for (const double x : c.prior_arcsec2)
            if (!(x <= c.prior_arcsec2[0] && -x <= c.prior_arcsec2[0] && is_finite(x)))
                return OptimalBridgeFault::prior;
    }
    return OptimalBridgeFault::none;
}

template <std::size_t capacity>
void add_point(const MotionCovariance& covariance, GapProblemOf<capacity>& problem, int place,
               const ColumnOf<capacity>& error) noexcept {
    const auto n = static_cast<unsigned>(problem.factor.n);
    if (problem.failed || n == capacity) return;
    problem.place[n] = static_cast<std::int8_t>(place);
    ColumnOf<capacity> row{};
    for (unsigned k = 0; k <= n; ++k) row[k] = covariance_of(covariance, problem, problem.place[k], place) + error[k];
    problem.failed = !add_row(problem.factor, row);
}

template <std::size_t capacity>
void advance(const MotionCovariance& covariance, const GapProblemOf<capacity>& problem, const GapDataOf<capacity>& data,
             GapSolutionOf<capacity>& solution) noexcept {
    const int stage = solution.stage++;
    if (stage == 0) {
        solution.rates = rates_of(problem);
        solution.done = !is_solvable(problem, solution.rates);
    } else if (stage == 1) {
        solve_points(problem, data, solution);
    } else if (stage < 2 + problem.n_gap) {
        solve_tick(covariance, problem, data, stage - 2, solution);
    } else if (stage == 2 + problem.n_gap) {
        solve_sum(covariance, problem, data, solution);
    } else {
        solve_probe(problem, data, solution);
    }
}

GapEstimate solve(const MotionCovariance& covariance, const GapProblem& problem, const GapData& data) noexcept {
    GapSolution solution;
    while (!solution.done) advance(covariance, problem, data, solution);
    return solution.estimate;
}

template void add_point(const MotionCovariance&, GapProblem&, int, const Column&) noexcept;
template void advance(const MotionCovariance&, const GapProblem&, const GapData&, GapSolution&) noexcept;

template void add_point(const MotionCovariance&, GapProblemOf<few_unknowns>&, int,
                        const ColumnOf<few_unknowns>&) noexcept;
template void advance(const MotionCovariance&, const GapProblemOf<few_unknowns>&, const GapDataOf<few_unknowns>&,
                      GapSolutionOf<few_unknowns>&) noexcept;

GapWeights weights(const MotionCovariance& covariance, const GapProblem& problem) noexcept {
    const auto rates = rates_of(problem);
    GapWeights out;
    if (!is_solvable(problem, rates)) return out;
    const Column with_points = with_gap(covariance, problem, 0, problem.n_gap);
    auto t = target_of(problem, rates, with_points, variance_in_gap(covariance, problem, 0, problem.n_gap),
                       stride_of(problem) * problem.n_gap);
    subtract(t.g, -t.rate_gain, rates.rate, problem.factor.n);
    out.weight = backward(problem.factor, t.g);
    out.variance_arcsec2 = t.variance;
    out.known = is_finite(t.variance) && t.variance > 0.0;
    return out;
}

}  // namespace zlg::core
