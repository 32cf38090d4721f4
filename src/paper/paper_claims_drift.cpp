// The claims about the drift budget and the best interval between switches.

#include <fmt/format.h>

#include <zlg/design/interval_formula.hpp>
#include <zlg/design/switching_interval.hpp>

#include "paper_claims_parts.hpp"
#include "paper_readings.hpp"

namespace zlg::paper {
namespace {

using namespace design;
using enum Verdict;

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

std::vector<Claim> claims_of_sawtooth() {
    const DriftCase hour = paper_case(hour_s);
    const GyroDrift& gyro = hour.gyro;
    const double warm = design::magnetic_rate_arcsec_s(gyro, hour_s);
    const double first = design::magnetic_integral_arcsec(gyro, 0.0, interval_s);
    const double second = design::magnetic_integral_arcsec(gyro, interval_s, 2.0 * interval_s);
    return {
        {"figure 3", "The magnetic drift makes a sawtooth whose amplitude is interval times magnetic drift.", agrees,
         fmt::format("At {:.0f} s the first segment ends at {:.1f} arcsec, {:.1f} with the warm-up during it. After an "
                     "hour the amplitude is {:.1f} arcsec.",
                     interval_s, interval_s * gyro.magnetic_arcsec_s, first, interval_s * warm)},
        {"eq (3)", "The drift is the non-magnetic one, one tooth and the greatest error of every switch.", agrees,
         fmt::format(
             "Right as a bound, {:.3f} deg/h in an hour at {:.0f} s, of which {:.3f} deg/h are switches that all "
             "err by {:.0f} arcsec to the same side. Independent ones with a third of that as rms give {:.4f} "
             "deg/h.",
             design::drift_bound_arcsec_s(hour, interval_s), interval_s, hour.switch_error_arcsec / interval_s,
             paper_switch_error_arcsec, independent_drift_arcsec_s(hour))},
        {"eq (4)", "The quasi-non-magnetic drift is the difference of two integrals from 0 to MT.", misprint,
         fmt::format("Two equal integrals differ by nothing. The second goes from MT to 2 MT: at {:.0f} s {:.2f} less "
                     "{:.2f} arcsec, or {:.5f} deg/h in magnitude.",
                     interval_s, first, second, (second - first) / (2.0 * interval_s))},
        {"eq (5)", "The magnetic drift approaches its warm value exponentially.", agrees,
         fmt::format("Right, if the listed thermal drift is the product of coefficient and warming: from {:.2f} to "
                     "{:.2f} deg/h in an hour.",
                     gyro.magnetic_arcsec_s, warm)},
        {"eq (6)", "The same for the thermal part, with integrals from 0 to 2 MT and from 0 to MT.", misprint,
         fmt::format("The limits are again those of (4) corrected. The result in print is right for the first two "
                     "segments, {:.5f} deg/h at {:.0f} s, and for them only: the mean over an hour is {:.5f} deg/h.",
                     design::quasi_nonmagnetic_as_printed_arcsec_s(gyro, interval_s), interval_s,
                     design::quasi_nonmagnetic_arcsec_s(gyro, hour_s, interval_s))},
    };
}

std::vector<Claim> claims_of_budget() {
    const Optimum first = corrected(paper_case(shortest_s));
    const Optimum last = corrected(paper_case(longest_s));
    const Optimum wrong_last = printed(paper_case(longest_s));
    const config::Config paper;
    const double thermal_arcsec_s = per_degree(hour_s).gyro.magnetic_thermal_arcsec_s;
    return {
        {"before eq (7)", "Eq (6) is put into eq (4).", misprint, "Into (3): (4) is what (6) has just evaluated."},
        {"eq (7)", "The drift of a run holds the quasi-non-magnetic drift of (6) as a constant.", wrong,
         fmt::format(
             "The thermal change dies out, so its mean falls with the run, (7c): A tau/t tanh(MT/2tau) (1 - "
             "exp(-t/tau)). In {:.0f} s the least drift is {:.3f} deg/h at {:.1f} s, not {:.3f} at {:.1f} s. At "
             "{:.0f} s both give {:.3f}.",
             longest_s, last.drift_arcsec_s, last.interval_s, wrong_last.drift_arcsec_s, wrong_last.interval_s,
             shortest_s, first.drift_arcsec_s)},
        {"after eq (7)", "With the run the least drift falls to the non-magnetic one and its interval grows.", agrees,
         fmt::format("Right of a gyro and of (7c): {:.3f} deg/h at {:.1f} s becomes {:.3f} at {:.1f} s. Not right of "
                     "(7), which stays {:.3f} deg/h above it for ever, {:.2f} deg/h if A is {:.0f} deg/h.",
                     first.drift_arcsec_s, first.interval_s, last.drift_arcsec_s, last.interval_s,
                     printed_floor_arcsec_s(paper_case(longest_s)), printed_floor_arcsec_s(per_degree(longest_s)),
                     thermal_arcsec_s)},
        {"parameters of figure 4",
         fmt::format("Thermal drift {} deg/h, warming {:.0f} C; (5) multiplies them.",
                     paper.drift.magnetic_thermal_arcsec_s, paper.gyro.temperature_rise_c),
         not_supported,
         fmt::format("Taken at its word A is {:.0f} deg/h, and (7) is least at {:.1f} s in {:.0f} s and {:.1f} s in "
                     "{:.0f} s: no minutes, and hardly a rise. The text, and a figure 5 that rises, fit A = {} deg/h.",
                     thermal_arcsec_s, printed(per_degree(shortest_s)).interval_s, shortest_s,
                     printed(per_degree(longest_s)).interval_s, longest_s, paper.drift.magnetic_thermal_arcsec_s)},
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

std::vector<Claim> claims_of_interval() {
    const DriftCase hour = paper_case(hour_s);
    const DriftCase longest = paper_case(longest_s);
    DriftCase cold = hour;
    cold.gyro.magnetic_thermal_arcsec_s = 0.0;
    const GyroDrift by_degrees = per_degree(hour_s).gyro;
    const double hour_interval_s = best_corrected_interval_s(hour_s);
    return {
        {"eq (8)", "The condition for the minimum of (7).", agrees,
         fmt::format(
             "It is the derivative of (7) as printed: at {:.0f} s in an hour {:.4e} deg/h per s, by differences "
             "of (7) {:.4e}. Its root there, {:.1f} s, is not the best interval, {:.1f} s, because (7) is "
             "wrong.",
             interval_s, design::derivative_as_printed_arcsec_s2(hour, interval_s), slope_as_printed(hour),
             printed(hour).interval_s, hour_interval_s)},
        {"figure 4", "The best interval is 1 to 2 minutes, much less than the thermal time.", not_supported,
         fmt::format("For the two shorter runs only: {:.1f} and {:.1f} s, but {:.1f} s in an hour and {:.1f} s in ten "
                     "hours, {:.0f} % of the thermal time.",
                     best_corrected_interval_s(shortest_s), best_corrected_interval_s(900.0), hour_interval_s,
                     best_corrected_interval_s(longest_s),
                     100.0 * best_corrected_interval_s(longest_s) / longest.gyro.thermal_time_s)},
        {"eq (9)", "A cubic for the best interval, from (8) by expansion of the exponentials.", wrong,
         fmt::format("The right side lacks a factor t, and a factor of 2 lost on the way turns the sign of the thermal "
                     "term. With t restored its root is {:.1f} s in an hour where (8) has {:.1f} s and (9c) {:.1f} s, "
                     "and above {:.0f} s it has none; with A = {:.0f} deg/h none above {:.0f} s.",
                     design::roots_as_printed(hour).smaller_s, printed(hour).interval_s,
                     design::corrected_roots(hour).smaller_s,
                     design::longest_run_as_printed_s(hour.gyro, hour.switch_error_arcsec),
                     by_degrees.magnetic_thermal_arcsec_s,
                     design::longest_run_as_printed_s(by_degrees, hour.switch_error_arcsec))},
        {"figure 5", "The best interval against the length of the run, from (9).", not_supported,
         fmt::format("It rises from {:.1f} to {:.1f} s, and (9) cannot have drawn that for all four runs: in {:.0f} s "
                     "it has no root. The corrected (9c) gives {:.1f} s there, the square root {:.0f} s.",
                     best_corrected_interval_s(shortest_s), best_corrected_interval_s(longest_s), longest_s,
                     design::corrected_roots(longest).smaller_s, design::closed_form_interval_s(longest))},
        {"after eq (9)", "Without thermal change the best interval is sqrt(dP t/Om).", agrees,
         fmt::format("In an hour {:.1f} s; the exact minimum without warm-up is {:.1f} s, with it {:.1f} s. It "
                     "presumes errors of one sign: where they are independent it costs {:.2f} times the least excess "
                     "over the non-magnetic drift in {:.0f} s and {:.2f} times in {:.0f} s.",
                     design::closed_form_interval_s(cold), corrected(cold).interval_s, hour_interval_s,
                     cost_of_rule(shortest_s), shortest_s, cost_of_rule(longest_s), longest_s)},
    };
}

}  // namespace

std::vector<Claim> claims_of_drift() { return joined({claims_of_sawtooth, claims_of_budget, claims_of_interval}); }

}  // namespace zlg::paper
