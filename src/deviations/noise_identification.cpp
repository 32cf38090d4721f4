#include <zlg/deviations/noise_identification.hpp>

#include "noise_means.hpp"

namespace zlg::deviations {
namespace {

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
    const auto noise = means.exponent();
    return noise ? std::optional{NoiseStep{.m = m, .means = means.count(), .noise = *noise}} : std::nullopt;
}

}  // namespace

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
