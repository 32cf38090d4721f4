#include <zlg/deviations/noise_identification.hpp>

#include <algorithm>
#include <cmath>

#include "noise_means.hpp"

namespace zlg::deviations {
namespace {

constexpr std::int64_t min_means = 30;
// So many means tell the exponent to a few hundredths; they are taken in runs spread over the record.
constexpr std::int64_t max_means = 1 << 14;
constexpr std::int64_t run_means = 1 << 10;
constexpr std::size_t steps_of_mean = 3;

std::optional<NoiseStep> step_of(const RecordView& view, std::int64_t m) {
    const std::int64_t n_means = view.n_intervals / m;
    const std::int64_t n_runs = n_means <= max_means ? 1 : max_means / run_means;
    const std::int64_t length = n_runs == 1 ? n_means : run_means;
    NoiseMeans means(m);
    for (std::int64_t run = 0; run < n_runs; ++run) {
        const std::int64_t first = n_runs == 1 ? 0 : run * ((n_means - length) / (n_runs - 1));
        for (std::int64_t k = first; k < first + length; ++k) means.add(view, k * m);
        means.interrupt();
    }
    return means.step(m);
}

}  // namespace

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

std::vector<NoiseStep> noise_steps(const AngleRecord& record, double least_known_ratio) {
    const auto view = view_of(record, least_known_ratio);
    std::vector<NoiseStep> steps;
    for (std::int64_t m = 1; m <= view.n_intervals / min_means; m *= 2)
        if (const auto step = step_of(view, m)) steps.push_back(*step);
    return steps;
}

std::optional<double> noise_exponent(std::span<const NoiseStep> steps, std::int64_t m) {
    double sum = 0.0, weight = 0.0;
    std::size_t taken = 0;
    for (std::size_t k = steps.size(); k-- > 0 && taken < steps_of_mean;) {
        if (steps[k].m > m) continue;
        sum += steps[k].noise * static_cast<double>(steps[k].means);
        weight += static_cast<double>(steps[k].means);
        ++taken;
    }
    if (taken == 0) return std::nullopt;
    return sum / weight;
}

}  // namespace zlg::deviations
