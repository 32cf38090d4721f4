#pragma once
// Curves of theory and points of the twin for figures 8 to 11.

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "paper_bridge.hpp"
#include "paper_curves.hpp"

namespace zlg::paper {

// Constant and linear are one estimator of the corrected sum, so that it has two curves.
inline constexpr std::array sum_orders{0, 2};
[[nodiscard]] inline const char* sum_order_name(int order) { return order == 2 ? "quadratic" : "constant = linear"; }

// One fit and order of the experiments at `x`: a component of each point, with its standard error.
[[nodiscard]] report::Series twin_points(Look look, const std::vector<double>& x,
                                         const std::vector<SubstitutionResult>& results, design::Fit fit, int order,
                                         const std::function<Measured(const SubstitutionPoint&)>& of);

// One number of the results, such as the length of the gap: the same for all fits and orders.
[[nodiscard]] std::vector<double> each(const std::vector<SubstitutionResult>& results,
                                       const std::function<double(const SubstitutionPoint&)>& of);

// What one figure varies: the gap at a place of its axis, the places of its curves, and the experiments on the axis.
struct Axis {
    std::function<BridgeCase(double)> case_at;
    std::vector<double> shown;
    const std::vector<SubstitutionResult>& results;
    std::vector<double> measured;  // the places of the results
};

// One series of a figure: the error of a gap by theory or by the print, or the twin's points of a fit.
struct Row {
    const char* name;
    int order = 0;
    int colour = 0;
    bool dashed = false;
    double (*of)(const BridgeCase&, int order) = nullptr;  // null: the points
    design::Fit fit = design::Fit::interpolation;          // of the points
};

[[nodiscard]] std::vector<report::Series> drawn(const Axis& axis, std::span<const Row> rows);

// The error that stays in the angle: theory, the series (20), and the twin. Where the rate passes zero theory is 0, and
// the print has another series.
[[nodiscard]] std::span<const Row> corrected(Region region);

// What is delivered in real time, extrapolated from four ticks.
[[nodiscard]] std::span<const Row> delivered();

}  // namespace zlg::paper
