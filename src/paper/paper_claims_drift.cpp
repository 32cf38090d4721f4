// The claims about the drift budget and the best interval between switches.

#include <zlg/design/interval_formula.hpp>
#include <zlg/design/switching_interval.hpp>

#include "paper_claims_parts.hpp"
#include "paper_trial.hpp"

namespace zlg::paper {
namespace {

using namespace design;

constexpr double interval_s = 90.0;  // between the "1 to 2 minutes" of the paper
constexpr double shortest_s = 600.0;
constexpr double hour_s = 3600.0;
constexpr double longest_s = 36000.0;

DriftCase paper_case(double run_s) { return study::drift_case({}, run_s); }
DriftCase per_degree(double run_s) { return drift_case_per_degree({}, run_s); }
Optimum printed(const DriftCase& task) { return design::optimum(IntervalMethod::as_printed, task); }
Optimum corrected(const DriftCase& task) { return design::optimum(IntervalMethod::corrected, task); }
double best_corrected_interval_s(double run_s) { return corrected(paper_case(run_s)).interval_s; }

// What switch errors leave in an hour that are independent, their rms a third of the greatest.
double independent_drift_arcsec_s(DriftCase task) {
    task.switch_error_arcsec /= 3.0;
    return design::independent_switch_drift_arcsec_s(task, interval_s);
}

std::vector<Finding> claims_of_sawtooth() {
    const DriftCase hour = paper_case(hour_s);
    const GyroDrift& gyro = hour.gyro;
    const double warm = design::magnetic_rate_arcsec_s(gyro, hour_s);
    const double first = design::magnetic_integral_arcsec(gyro, 0.0, interval_s);
    const double second = design::magnetic_integral_arcsec(gyro, interval_s, 2.0 * interval_s);
    return {
        {"figure 3", {interval_s, interval_s * gyro.magnetic_arcsec_s, first, interval_s * warm}},
        {"eq (3)",
         {design::drift_bound_arcsec_s(hour, interval_s), interval_s, hour.switch_error_arcsec / interval_s,
          paper_switch_error_arcsec, independent_drift_arcsec_s(hour)}},
        {"eq (4)", {interval_s, first, second, (second - first) / (2.0 * interval_s)}},
        {"eq (5)", {gyro.magnetic_arcsec_s, warm}},
        {"eq (6)",
         {design::quasi_nonmagnetic_as_printed_arcsec_s(gyro, interval_s), interval_s,
          design::quasi_nonmagnetic_arcsec_s(gyro, hour_s, interval_s)}},
    };
}

std::vector<Finding> claims_of_budget() {
    const Optimum first = corrected(paper_case(shortest_s));
    const Optimum last = corrected(paper_case(longest_s));
    const Optimum wrong_last = printed(paper_case(longest_s));
    const config::Config paper;
    const double thermal_arcsec_s = per_degree(hour_s).gyro.magnetic_thermal_arcsec_s;
    return {
        {"before eq (7)", {}},
        {"eq (7)",
         {longest_s, last.drift_arcsec_s, last.interval_s, wrong_last.drift_arcsec_s, wrong_last.interval_s, shortest_s,
          first.drift_arcsec_s}},
        {"after eq (7)",
         {first.drift_arcsec_s, first.interval_s, last.drift_arcsec_s, last.interval_s,
          printed_floor_arcsec_s(paper_case(longest_s)), printed_floor_arcsec_s(per_degree(longest_s)),
          thermal_arcsec_s}},
        {"parameters of figure 4",
         {paper.drift.magnetic_thermal_arcsec_s, paper.gyro.temperature_rise_c, thermal_arcsec_s,
          printed(per_degree(shortest_s)).interval_s, shortest_s, printed(per_degree(longest_s)).interval_s, longest_s,
          paper.drift.magnetic_thermal_arcsec_s}},
    };
}

// (7) as printed by differences, "/s per s.
double slope_as_printed(const DriftCase& task) {
    constexpr double step_s = 0.01;
    const auto drift = [&](double x_s) { return design::terms_as_printed(task, x_s).total_arcsec_s(); };
    return (drift(interval_s + step_s) - drift(interval_s - step_s)) / (2.0 * step_s);
}

// The square root's cost where switch errors are independent, their rms a third of the greatest.
double cost_of_rule(double run_s) {
    DriftCase task = paper_case(run_s);
    task.gyro.nonmagnetic_arcsec_s = 0.0;
    const double rule_s = design::closed_form_interval_s(task);
    task.switch_error_arcsec /= 3.0;
    return design::random_sign_drift_arcsec_s(task, rule_s) /
           design::random_sign_drift_arcsec_s(task, design::random_sign_interval_s(task));
}

std::vector<Finding> claims_of_interval() {
    const DriftCase hour = paper_case(hour_s);
    const DriftCase longest = paper_case(longest_s);
    DriftCase cold = hour;
    cold.gyro.magnetic_thermal_arcsec_s = 0.0;
    const GyroDrift by_degrees = per_degree(hour_s).gyro;
    const double hour_interval_s = best_corrected_interval_s(hour_s);
    return {
        {"eq (8)",
         {interval_s, design::derivative_as_printed_arcsec_s2(hour, interval_s), slope_as_printed(hour),
          printed(hour).interval_s, hour_interval_s}},
        {"figure 4",
         {best_corrected_interval_s(shortest_s), best_corrected_interval_s(900.0), hour_interval_s,
          best_corrected_interval_s(longest_s),
          100.0 * best_corrected_interval_s(longest_s) / longest.gyro.thermal_time_s}},
        {"eq (9)",
         {design::roots_as_printed(hour).smaller_s, printed(hour).interval_s, design::corrected_roots(hour).smaller_s,
          design::longest_run_as_printed_s(hour.gyro, hour.switch_error_arcsec), by_degrees.magnetic_thermal_arcsec_s,
          design::longest_run_as_printed_s(by_degrees, hour.switch_error_arcsec)}},
        {"figure 5",
         {best_corrected_interval_s(shortest_s), best_corrected_interval_s(longest_s), longest_s,
          design::corrected_roots(longest).smaller_s, design::closed_form_interval_s(longest)}},
        {"after eq (9)",
         {design::closed_form_interval_s(cold), corrected(cold).interval_s, hour_interval_s, cost_of_rule(shortest_s),
          shortest_s, cost_of_rule(longest_s), longest_s}},
    };
}

}  // namespace

std::vector<Finding> claims_of_drift() { return joined({claims_of_sawtooth, claims_of_budget, claims_of_interval}); }

}  // namespace zlg::paper
