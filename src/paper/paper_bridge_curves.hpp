#pragma once
// Curves of theory and points of the twin for figures 8 to 11.

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <zlg/report/figure.hpp>
#include <zlg/report/number_text.hpp>

#include "paper_bridge.hpp"

namespace zlg::paper {

// Constant and linear are one estimator of the corrected sum, so that it has two curves.
inline constexpr std::array sum_orders{0, 2};
[[nodiscard]] inline const char* sum_order_name(int order) { return order == 2 ? "quadratic" : "constant = linear"; }

struct Look {
    std::string name;
    int colour = 0;
    bool dashed = false;
};

[[nodiscard]] inline report::Series curve(Look look, const std::vector<double>& x,
                                          const std::function<double(double)>& y_of) {
    report::Series s{.name = std::move(look.name), .x = x, .y = {}, .y_error = {}};
    s.dashed = look.dashed;
    s.colour = look.colour;
    for (const double at : x) s.y.push_back(y_of(at));
    return s;
}

// One component of one fit and order of the experiments; `x` in their order.
[[nodiscard]] inline report::Series twin_points(Look look, const std::vector<double>& x,
                                                const std::vector<SubstitutionResult>& results, design::Fit fit,
                                                int order, Region region) {
    report::Series s{.name = std::move(look.name), .x = x, .y = {}, .y_error = {}, .mark = report::Mark::points};
    s.colour = look.colour;
    for (const SubstitutionResult& result : results) {
        const Measured m = measured(point_of(result, fit, order), region);
        s.y.push_back(m.arcsec);
        s.y_error.push_back(m.error);
    }
    return s;
}

// Three curves and their points: what is delivered in real time, extrapolated from four ticks.
[[nodiscard]] inline std::vector<report::Series> delivered(const std::vector<double>& curve_x,
                                                           const std::function<double(int order, double x)>& theory,
                                                           const std::vector<double>& point_x,
                                                           const std::vector<SubstitutionResult>& results,
                                                           Region region) {
    std::vector<report::Series> all;
    for (int order = 0; order < 3; ++order)
        all.push_back(curve({order_names[static_cast<std::size_t>(order)], order}, curve_x,
                            [&](double x) { return theory(order, x); }));
    for (int order = 0; order < 3; ++order)
        all.push_back(twin_points({fmt::format("twin, {}", order_names[static_cast<std::size_t>(order)]), order},
                                  point_x, results, design::Fit::extrapolation, order, region));
    return all;
}

[[nodiscard]] inline std::vector<double> evenly(double from, double to, int n) {
    std::vector<double> x;
    for (int i = 0; i < n; ++i) x.push_back(from + (to - from) * i / (n - 1.0));
    return x;
}

[[nodiscard]] inline std::string with_error(const Measured& m, int decimals) {
    return fmt::format("{} \u00B1 {}", report::fixed_number(m.arcsec, decimals),
                       report::fixed_number(m.error, decimals));
}

}  // namespace zlg::paper
