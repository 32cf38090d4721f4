#include "lag_one.hpp"

#include <cmath>

namespace zlg::deviations {

void LagOne::add(double value) {
    if (std::isfinite(value)) return add_to(0, value);
    for (auto& level : level_) level.has_previous = false;
}

void LagOne::add_to(std::size_t order, double value) {
    auto& level = level_[order];
    // Moments about the first value: a large constant would drown what varies.
    if (level.n == 0) level.origin = value;
    const double x = value - level.origin, before = level.previous - level.origin;
    const double difference = value - level.previous;
    const bool pair = level.has_previous;
    ++level.n;
    level.sum += x;
    level.square += x * x;
    if (pair) {
        ++level.pairs;
        level.product += x * before;
        level.head += before;
        level.tail += x;
    }
    level.previous = value;
    level.has_previous = true;
    if (pair && order + 1 < level_.size()) add_to(order + 1, difference);
}

std::optional<double> LagOne::exponent() const {
    for (std::size_t d = 0; d < level_.size(); ++d) {
        const auto& level = level_[d];
        if (level.n + static_cast<std::int64_t>(d) < min_means || level.pairs < 1) return std::nullopt;
        const auto n = static_cast<double>(level.n), pairs = static_cast<double>(level.pairs);
        const double mean = level.sum / n;
        const double variance = level.square - n * mean * mean;
        const double covariance = level.product - mean * (level.head + level.tail) + pairs * mean * mean;
        if (!(variance > 0.0)) return std::nullopt;
        const double r1 = covariance / variance * (n / (pairs + 1.0));
        const double delta = r1 / (1.0 + r1);
        if (!(delta >= 0.25) || d + 1 == level_.size()) return -2.0 * (delta + static_cast<double>(d));
    }
    return std::nullopt;
}

}  // namespace zlg::deviations
