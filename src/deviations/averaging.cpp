#include <zlg/deviations/averaging.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <zlg/deviations/series.hpp>

namespace zlg::deviations {

std::vector<std::int64_t> octave_factors(std::int64_t largest) {
    std::vector<std::int64_t> factors;
    for (std::int64_t m = 1; m <= largest; m *= 2) {
        factors.push_back(m);
        if (m > largest / 2) break;
    }
    return factors;
}

std::vector<std::int64_t> decade_factors(std::int64_t largest) {
    std::vector<std::int64_t> factors;
    for (std::int64_t decade = 1; decade <= largest; decade *= 10) {
        for (const std::int64_t step : {1, 2, 4})
            if (decade <= largest / step) factors.push_back(decade * step);
        if (decade > largest / 10) break;
    }
    return factors;
}

std::vector<std::int64_t> log_factors(int per_decade, std::int64_t largest) {
    if (per_decade < 1 || per_decade > 10000)
        throw SeriesError(fmt::format("taus per decade: {}, allowed is 1 to 10000", per_decade));
    std::vector<std::int64_t> factors;
    for (int k = 0;; ++k) {
        const double m = std::round(std::pow(10.0, k / static_cast<double>(per_decade)));
        if (!(m <= static_cast<double>(largest))) return factors;
        const auto factor = static_cast<std::int64_t>(m);
        if (factors.empty() || factor > factors.back()) factors.push_back(factor);
    }
}

std::vector<std::int64_t> all_factors(std::int64_t largest) {
    std::vector<std::int64_t> factors;
    for (std::int64_t m = 1; m <= largest; ++m) factors.push_back(m);
    return factors;
}

std::vector<std::int64_t> nearest_factors(std::span<const double> taus_s, double rate_hz, std::int64_t largest) {
    std::vector<std::int64_t> factors;
    for (const double tau_s : taus_s) {
        const double m = std::round(tau_s * rate_hz);
        if (!(m >= 1.0 && m <= static_cast<double>(largest)))
            throw SeriesError(fmt::format("tau: {} s is {} intervals, allowed is 1 to {}", tau_s, m, largest));
        factors.push_back(static_cast<std::int64_t>(m));
    }
    std::ranges::sort(factors);
    factors.erase(std::unique(factors.begin(), factors.end()), factors.end());
    return factors;
}

std::int64_t largest_factor(DeviationKind kind, std::int64_t n_intervals) {
    // The angle averaged over the third m ends on a border: 3m - 1 intervals.
    return is_modified(kind) ? (n_intervals + 1) / 3 : n_intervals / difference_order(kind);
}

}  // namespace zlg::deviations
