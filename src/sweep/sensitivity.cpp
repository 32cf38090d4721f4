#include <zlg/sweep/sensitivity.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>

#include <zlg/chance/draw.hpp>
#include <zlg/sweep/statistics.hpp>

namespace zlg::sweep {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

// From 1; equal values share the mean of their ranks.
std::vector<double> ranks(std::span<const double> values) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t k) { return values[k]; });
    std::vector<double> rank(values.size());
    for (std::size_t first = 0; first < order.size();) {
        std::size_t end = first + 1;
        while (end < order.size() && values[order[end]] == values[order[first]]) ++end;
        for (std::size_t k = first; k < end; ++k) rank[order[k]] = 0.5 * static_cast<double>(first + 1 + end);
        first = end;
    }
    return rank;
}

bool is_whole(const SobolDesign& design, std::size_t row) {
    return std::isfinite(design.a[row]) && std::isfinite(design.b[row]) &&
           std::ranges::all_of(design.mixed, [row](const auto& column) { return std::isfinite(column[row]); });
}

// The indices of some rows of a design, first and total of each input in turn.
class Estimator {
public:
    // The sums are of differences from a middle, so that a large mean costs no digits.
    Estimator(const SobolDesign& design, const std::vector<std::size_t>& whole) : design_{design} {
        double sum = 0.0;
        for (const std::size_t row : whole) sum += design.a[row];
        middle_ = sum / static_cast<double>(whole.size());
    }

    double variance(const std::vector<std::size_t>& rows) const {
        double sum = 0.0, squares = 0.0;
        for (const std::size_t row : rows) {
            const double x = design_.a[row] - middle_;
            sum += x;
            squares += x * x;
        }
        const auto n = static_cast<double>(rows.size());
        return (squares - sum * sum / n) / (n - 1.0);
    }

    std::vector<double> indices(const std::vector<std::size_t>& rows) const {
        const double scale = (2.0 * static_cast<double>(rows.size()) - 1.0) * variance(rows);
        std::vector<double> found;
        for (const std::vector<double>& mixed : design_.mixed) {
            double from_b = 0.0, from_a = 0.0;
            for (const std::size_t row : rows) {
                from_b += (design_.b[row] - mixed[row]) * (design_.b[row] - mixed[row]);
                from_a += (design_.a[row] - mixed[row]) * (design_.a[row] - mixed[row]);
            }
            found.push_back(1.0 - from_b / scale);
            found.push_back(from_a / scale);
        }
        return found;
    }

private:
    const SobolDesign& design_;
    double middle_ = 0.0;
};

// By index: its values over the resamples, sorted.
std::vector<std::vector<double>> resampled(const Estimator& estimator, const std::vector<std::size_t>& whole,
                                           std::size_t n_indices, int n_resamples, std::uint64_t seed) {
    std::vector<std::vector<double>> found(n_indices);
    std::vector<std::size_t> rows(whole.size());
    for (int k = 0; k < n_resamples; ++k) {
        chance::Draw draw{seed, chance::Cause::sweep_resampling, static_cast<std::uint64_t>(k)};
        std::ranges::generate(rows, [&] { return whole[draw.below(whole.size())]; });
        const std::vector<double> indices = estimator.indices(rows);
        for (std::size_t i = 0; i < n_indices; ++i)
            if (std::isfinite(indices[i])) found[i].push_back(indices[i]);
    }
    for (std::vector<double>& values : found) std::ranges::sort(values);
    return found;
}

double low_of(const std::vector<double>& sorted) { return sorted.empty() ? unknown : quantile(sorted, 0.025); }
double high_of(const std::vector<double>& sorted) { return sorted.empty() ? unknown : quantile(sorted, 0.975); }

void check(const SobolDesign& design) {
    if (design.mixed.empty()) throw std::invalid_argument("a design without an input has no indices");
    const auto differs = [&](const auto& column) { return column.size() != design.a.size(); };
    if (differs(design.b) || std::ranges::any_of(design.mixed, differs))
        throw std::invalid_argument("the columns of a design are not of one length");
}

// Row `row` of the design, of all points: A is 0, A_B^i is i + 1, B is d + 1.
struct Layout {
    std::size_t n_rows;
    std::size_t n_inputs;
    bool in_blocks;

    [[nodiscard]] std::size_t at(std::size_t row, std::size_t kind) const {
        if (!in_blocks) return row * (n_inputs + 2) + kind;
        const std::size_t block = kind == 0 ? 0 : kind == n_inputs + 1 ? 1 : kind + 1;
        return block * n_rows + row;
    }

    [[nodiscard]] bool fits(std::span<const double> points) const {
        const auto x = [&](std::size_t row, std::size_t kind, std::size_t column) {
            return points[at(row, kind) * n_inputs + column];
        };
        for (std::size_t row = 0; row < n_rows; ++row)
            for (std::size_t input = 0; input < n_inputs; ++input)
                for (std::size_t column = 0; column < n_inputs; ++column) {
                    const std::size_t from = column == input ? n_inputs + 1 : 0;
                    if (x(row, input + 1, column) != x(row, from, column)) return false;
                }
        return true;
    }
};

}  // namespace

std::optional<double> rank_correlation(std::span<const double> x, std::span<const double> y) {
    if (x.size() != y.size() || x.size() < 3) return std::nullopt;
    const std::vector<double> a = ranks(x);
    const std::vector<double> b = ranks(y);
    const double middle = 0.5 * static_cast<double>(x.size() + 1);
    double ab = 0.0, aa = 0.0, bb = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) {
        ab += (a[k] - middle) * (b[k] - middle);
        aa += (a[k] - middle) * (a[k] - middle);
        bb += (b[k] - middle) * (b[k] - middle);
    }
    if (!(aa > 0.0 && bb > 0.0)) return std::nullopt;
    return ab / std::sqrt(aa * bb);
}

std::size_t independent_gyros(std::size_t n_rows, std::size_t n_parameters) {
    const auto d = static_cast<double>(n_parameters);
    return static_cast<std::size_t>(static_cast<double>(n_rows) * (d + 2.0) * (d + 2.0) /
                                    ((d - 1.0) * (d - 1.0) + 3.0));
}

double chance_correlation(std::size_t n) { return 1.96 / std::sqrt(static_cast<double>(n) - 1.0); }

SobolIndices sobol_indices(const SobolDesign& design, int n_resamples, std::uint64_t seed) {
    check(design);
    std::vector<std::size_t> whole;
    for (std::size_t row = 0; row < design.a.size(); ++row)
        if (is_whole(design, row)) whole.push_back(row);
    SobolIndices result{.n_rows = whole.size(), .n_dropped = design.a.size() - whole.size()};
    result.inputs.assign(design.mixed.size(), {unknown, unknown, unknown, unknown, unknown, unknown});
    if (whole.size() < 2) return result;
    const Estimator estimator{design, whole};
    result.variance = estimator.variance(whole);
    if (!(result.variance > 0.0)) return result;
    const std::vector<double> indices = estimator.indices(whole);
    const auto spread = resampled(estimator, whole, indices.size(), n_resamples, seed);
    for (std::size_t i = 0; i < result.inputs.size(); ++i)
        result.inputs[i] = {indices[2 * i],     low_of(spread[2 * i]),     high_of(spread[2 * i]),
                            indices[2 * i + 1], low_of(spread[2 * i + 1]), high_of(spread[2 * i + 1])};
    return result;
}

SobolDesign as_design(std::span<const double> points, std::span<const double> values, std::size_t n_inputs) {
    const std::size_t n_points = n_inputs == 0 ? 0 : points.size() / n_inputs;
    if (n_points == 0 || n_points != values.size() || n_points % (n_inputs + 2) != 0)
        throw std::invalid_argument(
            fmt::format("{} points of {} inputs and {} values: allowed is one value a point, and n ({} + 2) points",
                        n_points, n_inputs, values.size(), n_inputs));
    const std::size_t n_rows = n_points / (n_inputs + 2);
    Layout layout{n_rows, n_inputs, true};
    if (!layout.fits(points)) layout.in_blocks = false;
    if (!layout.fits(points))
        throw std::invalid_argument(
            "the points are no design of Saltelli: allowed are blocks A, B, A with one column of B after the other, or "
            "the same row by row: A, the mixed points, B");
    const auto column = [&](std::size_t kind) {
        std::vector<double> made;
        for (std::size_t row = 0; row < n_rows; ++row) made.push_back(values[layout.at(row, kind)]);
        return made;
    };
    SobolDesign design{.a = column(0), .b = column(n_inputs + 1), .mixed = {}};
    for (std::size_t input = 0; input < n_inputs; ++input) design.mixed.push_back(column(input + 1));
    return design;
}

}  // namespace zlg::sweep
