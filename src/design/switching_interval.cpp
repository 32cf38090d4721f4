#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <boost/math/policies/policy.hpp>
#include <boost/math/tools/roots.hpp>
#include <zlg/design/error.hpp>
#include <zlg/design/interval_formula.hpp>
#include <zlg/design/switching_interval.hpp>

#include "range_check.hpp"

namespace zlg::design {

namespace {

// Budgets are sums of powers of L and of functions of L/tau, whose features are as wide as L itself: a step of 2 %
// passes over none.
constexpr double scan_step_ratio = 0.02;

// Where slope changes from negative to not negative between low and high, to the last bits of x. A jump there is a
// kink.
template <class Slope> double rising_zero(const Slope& slope, double low, double high) {
    // The bracket is one. What the library would say of another needs streams, and they are half of the lab page's
    // module.
    using Policy =
        boost::math::policies::policy<boost::math::policies::domain_error<boost::math::policies::ignore_error>,
                                      boost::math::policies::evaluation_error<boost::math::policies::ignore_error>>;
    std::uintmax_t iterations = 200;
    const auto bracket = boost::math::tools::toms748_solve(
        slope, low, high, boost::math::tools::eps_tolerance<double>(), iterations, Policy{});
    return bracket.first + (bracket.second - bracket.first) / 2.0;
}

// Point of least value among the minima inside (low, high) and high itself; the smallest of equal ones.
//
// A search on values alone ends at the root of the rounding error, 1e-8 at best; the slope gives the point to full
// precision. value, slope  of x; slope has the sign of the derivative.
template <class Value, class Slope> double min_point(const Value& value, const Slope& slope, double low, double high) {
    double best = high;
    double best_value = std::numeric_limits<double>::infinity();
    const auto consider = [&](double x) {
        const double at_x = value(x);
        if (at_x < best_value) best = x, best_value = at_x;
    };
    const double cells = std::ceil(std::max(1.0, std::log(high / low) / scan_step_ratio));
    double left = low;
    double left_slope = slope(left);
    for (double cell = 1.0; cell <= cells; ++cell) {
        const double right = cell < cells ? low * std::pow(high / low, cell / cells) : high;
        const double right_slope = slope(right);
        if (left_slope < 0.0 && right_slope >= 0.0) consider(rising_zero(slope, left, right));
        left = right;
        left_slope = right_slope;
    }
    consider(high);
    return best;
}

constexpr std::string_view where = "switching interval";

// In the order of the enumerators.
constexpr std::array<std::string_view, interval_methods.size()> names{"corrected", "worst_case", "as_printed",
                                                                      "closed_form"};
constexpr std::array<std::string_view, 3> sentences{
    "the drift is least at an interval shorter than the run",
    "the drift is least without a switch: in this run none pays for itself",
    "this budget holds no magnetic drift that a switch could reverse: best is not to switch"};

[[noreturn]] void refuse(IntervalMethod method) {
    throw DesignError(fmt::format("{}: method {} is none of the {} that there are", where, static_cast<int>(method),
                                  interval_methods.size()));
}

// Each slope is L times the derivative of the budget with respect to L, in arcsec/s.

double slope_corrected(const DriftCase& task, double interval_s) {
    const auto& gyro = task.gyro;
    const double sech = 1.0 / std::cosh(interval_s / (2.0 * gyro.thermal_time_s));
    const double warmed = -std::expm1(-task.run_s / gyro.thermal_time_s);
    const double magnetic_arcsec_s =
        std::abs(gyro.magnetic_thermal_arcsec_s) / 2.0 * sech * sech * warmed + std::abs(gyro.magnetic_arcsec_s);
    return interval_s * magnetic_arcsec_s / task.run_s - task.switch_error_arcsec / interval_s;
}

double slope_as_printed(const DriftCase& task, double interval_s) {
    return interval_s * derivative_as_printed_arcsec_s2(task, interval_s);
}

// dK/dL at t, arcsec/s.
double kernel_slope_arcsec_s(const GyroDrift& gyro, double interval_s, double at_s) {
    const double tau_s = gyro.thermal_time_s;
    const double tanh = std::tanh(interval_s / (2.0 * tau_s));
    return (magnetic_rate_arcsec_s(gyro, at_s) +
            gyro.magnetic_thermal_arcsec_s * std::exp(-at_s / tau_s) * tanh * tanh) /
           2.0;
}

// dS/dL, arcsec/s.
double start_slope_arcsec_s(const GyroDrift& gyro, double interval_s, FirstSegment first) {
    if (first == FirstSegment::full) return kernel_slope_arcsec_s(gyro, interval_s, 0.0);
    const double half_ratio = interval_s / (2.0 * gyro.thermal_time_s);
    return -gyro.magnetic_thermal_arcsec_s / 2.0 * std::tanh(half_ratio) / std::cosh(half_ratio);
}

double slope_worst_case(const DriftCase& task, double interval_s, FirstSegment first) {
    const double start_arcsec = start_residue_arcsec(task.gyro, interval_s, first);
    const double end_arcsec = kernel_arcsec(task.gyro, interval_s, task.run_s);
    const double magnetic_arcsec_s =
        std::copysign(1.0, start_arcsec) * start_slope_arcsec_s(task.gyro, interval_s, first) +
        std::copysign(1.0, end_arcsec) * kernel_slope_arcsec_s(task.gyro, interval_s, task.run_s);
    return interval_s * magnetic_arcsec_s / task.run_s - task.switch_error_arcsec / interval_s;
}

// Of a run that ends anywhere in a segment: (L (S S' + K K'/3)/t^2 + N L N')/sqrt(S^2/t^2 + K^2/(3 t^2) +
// N^2).
double slope_expected(const DriftCase& task, double interval_s, FirstSegment first) {
    const double noise_arcsec_s = independent_switch_drift_arcsec_s(task, interval_s);
    const double start_arcsec = start_residue_arcsec(task.gyro, interval_s, first);
    const double end_arcsec = kernel_arcsec(task.gyro, interval_s, task.run_s);
    const double magnetic = start_arcsec * start_slope_arcsec_s(task.gyro, interval_s, first) +
                            end_arcsec * kernel_slope_arcsec_s(task.gyro, interval_s, task.run_s) / 3.0;
    return (interval_s * magnetic / (task.run_s * task.run_s) - 0.5 * noise_arcsec_s * noise_arcsec_s) /
           expected_drift_arcsec_s(task, interval_s, first);
}

// A budget or a slope for one first segment, as a function of case and interval.
auto with(double (*of)(const DriftCase&, double, FirstSegment), FirstSegment first) {
    return [of, first](const DriftCase& task, double interval_s) { return of(task, interval_s, first); };
}

DriftCase without_nonmagnetic(DriftCase task) {
    task.gyro.nonmagnetic_arcsec_s = 0.0;
    return task;
}

bool has_magnetic_drift(const GyroDrift& gyro) {
    return gyro.magnetic_arcsec_s != 0.0 || gyro.magnetic_thermal_arcsec_s != 0.0;
}

OptimumStatus status_of(double interval_s, double run_s, bool magnetic_drift) {
    if (!magnetic_drift) return OptimumStatus::no_magnetic_drift;
    return interval_s < run_s ? OptimumStatus::inside : OptimumStatus::whole_run;
}

// Below this interval the switches alone cost more than a run without any.
double min_of_one_sign_s(const DriftCase& task, double whole_run_arcsec_s) {
    return task.switch_error_arcsec / whole_run_arcsec_s;
}

double min_of_random_sign_s(const DriftCase& task, double whole_run_arcsec_s) {
    const double ratio_s = task.switch_error_arcsec / whole_run_arcsec_s;
    return ratio_s * ratio_s / task.run_s;
}

// Minimum of a budget by its value and slope, as functions of case and interval. No budget is below what its switches
// cost, so below the interval `least` at which they alone cost as much as a run without a switch there is no minimum:
// the search begins there.
template <class Drift, class Slope, class Least>
Optimum searched(const DriftCase& task, const Drift& drift, const Slope& slope, const Least& least) {
    check(task);
    // The nonmagnetic drift is the same everywhere and would only blur the comparison of minima.
    const DriftCase excess = without_nonmagnetic(task);
    const double whole_run_arcsec_s = drift(excess, task.run_s);
    const double min_s = std::min(least(excess, whole_run_arcsec_s), task.run_s);
    require(std::isfinite(whole_run_arcsec_s) && std::isfinite(task.run_s / min_s), where, "drift over the whole run",
            whole_run_arcsec_s, "what numbers can hold");
    const double interval_s = min_point([&](double length_s) { return drift(excess, length_s); },
                                        [&](double length_s) { return slope(excess, length_s); }, min_s, task.run_s);
    return {status_of(interval_s, task.run_s, has_magnetic_drift(task.gyro)), interval_s, drift(task, interval_s)};
}

// Minimum of a budget that has a formula for it and ignores the warm-up.
Optimum limited_to_run(IntervalMethod method, const DriftCase& task, double formula_s) {
    const double interval_s = std::min(formula_s, task.run_s);
    return {status_of(interval_s, task.run_s, task.gyro.magnetic_arcsec_s != 0.0), interval_s,
            drift_arcsec_s(method, task, interval_s)};
}

double closed_form_drift_arcsec_s(const DriftCase& task, double interval_s) {
    DriftCase cold = task;
    cold.gyro.magnetic_thermal_arcsec_s = 0.0;
    return corrected_terms(cold, interval_s).total_arcsec_s();
}

}  // namespace

std::string_view name(IntervalMethod method) { return names.at(static_cast<std::size_t>(method)); }

std::string_view sentence(OptimumStatus status) { return sentences.at(static_cast<std::size_t>(status)); }

double drift_arcsec_s(IntervalMethod method, const DriftCase& task, double interval_s) {
    switch (method) {
        case IntervalMethod::corrected: return corrected_terms(task, interval_s).total_arcsec_s();
        case IntervalMethod::worst_case: return worst_case_drift_arcsec_s(task, interval_s);
        case IntervalMethod::as_printed: return terms_as_printed(task, interval_s).total_arcsec_s();
        case IntervalMethod::closed_form: return closed_form_drift_arcsec_s(task, interval_s);
    }
    refuse(method);
}

Optimum worst_case_optimum(const DriftCase& task, FirstSegment first) {
    return searched(task, with(worst_case_drift_arcsec_s, first), with(slope_worst_case, first), min_of_one_sign_s);
}

Optimum expected_optimum(const DriftCase& task, FirstSegment first) {
    return searched(task, with(expected_drift_arcsec_s, first), with(slope_expected, first), min_of_random_sign_s);
}

Optimum optimum(IntervalMethod method, const DriftCase& task) {
    const auto drift = [method](const DriftCase& t, double interval_s) {
        return drift_arcsec_s(method, t, interval_s);
    };
    switch (method) {
        case IntervalMethod::corrected: return searched(task, drift, slope_corrected, min_of_one_sign_s);
        case IntervalMethod::as_printed: return searched(task, drift, slope_as_printed, min_of_one_sign_s);
        case IntervalMethod::worst_case: return worst_case_optimum(task, FirstSegment::full);
        case IntervalMethod::closed_form: return limited_to_run(method, task, closed_form_interval_s(task));
    }
    refuse(method);
}

}  // namespace zlg::design
