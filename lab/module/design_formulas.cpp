// The theory of the designer for a configured gyro.
#include "design_formulas.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include <zlg/config/schema.hpp>
#include <zlg/core/compensation/polynomial_fit.hpp>
#include <zlg/design/drift_budget.hpp>
#include <zlg/design/error.hpp>
#include <zlg/design/interval_formula.hpp>
#include <zlg/design/switching_interval.hpp>
#include <zlg/study/gyro_drift.hpp>

namespace zlg::lab {
namespace {

constexpr int longest_gap = 32;  // positions of the fit are at most 64

template <class Work>
double number(const Work& work) {
    try {
        return work();
    } catch (const design::DesignError&) {
        return std::numeric_limits<double>::quiet_NaN();
    } catch (const config::ConfigError&) {  // a field or a profile, which no closed form knows
        return std::numeric_limits<double>::quiet_NaN();
    }
}

}  // namespace

double drift_arcsec_s(const config::Config& config, Budget budget, double interval_s, double run_s,
                      double switch_error_arcsec) {
    const design::FirstSegment first = config.switching.first_segment;
    return number([&] {
        const design::DriftCase task{study::gyro_drift(config), switch_error_arcsec, run_s};
        if (budget == Budget::as_printed) return design::terms_as_printed(task, interval_s).total_arcsec_s();
        return budget == Budget::worst_case ? design::worst_case_drift_arcsec_s(task, interval_s, first)
                                            : design::expected_drift_arcsec_s(task, interval_s, first);
    });
}

double interval_s(const config::Config& config, IntervalLaw law, double run_s, double switch_error_arcsec) {
    return number([&] {
        const design::DriftCase task{study::gyro_drift(config), switch_error_arcsec, run_s};
        return law == IntervalLaw::closed_form
                   ? design::closed_form_interval_s(task)
                   : design::expected_optimum(task, config.switching.first_segment).interval_s;
    });
}

std::vector<double> gap_weights(const config::Compensation& points, bool extrapolates, int order, int gap_ticks) {
    gap_ticks = std::clamp(gap_ticks, 1, longest_gap);
    std::array<std::int32_t, core::max_fit_points> position{};
    int n = 0;
    const auto add = [&](int first, int count) {
        for (int k = 0; k < count && n < core::max_fit_points; ++k) position[static_cast<std::size_t>(n++)] = first + k;
    };
    const int before = extrapolates ? points.extrapolation_points : points.points_before;
    add(1 - before, before);
    if (!extrapolates) add(gap_ticks + 1, points.points_after);
    const core::PolynomialFit fit{position, n, order};
    std::vector<double> sum(static_cast<std::size_t>(n));
    for (int j = 1; j <= gap_ticks; ++j) {
        const core::FitWeights weights = fit.weights(j);
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += weights[k];
    }
    return sum;
}

}  // namespace zlg::lab
