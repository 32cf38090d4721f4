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

double chance_correlation(std::size_t n) { return 1.96 / std::sqrt(static_cast<double>(n) - 1.0); }

}  // namespace zlg::sweep
