#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include <zlg/design/drift_budget.hpp>

#include "range_check.hpp"

namespace zlg::design {

namespace {

constexpr std::string_view where = "drift budget";

void require_interval(double interval_s, double run_s) {
    require_positive(where, "interval_s", interval_s);
    require(interval_s <= run_s, where, "interval_s", interval_s, fmt::format("at most the run of {} s", run_s));
}

void check(const DriftCase& task, double interval_s) {
    check(task);
    require_interval(interval_s, task.run_s);
}

double sawtooth_arcsec_s(const DriftCase& task, double interval_s) {
    return interval_s * std::abs(task.gyro.magnetic_arcsec_s) / task.run_s;
}

// What the sawtooth leaves at the worst end.
double worst_end_arcsec_s(const DriftCase& task, double interval_s, FirstSegment first) {
    const double start_arcsec = start_residue_arcsec(task.gyro, interval_s, first);
    const double end_arcsec = kernel_arcsec(task.gyro, interval_s, task.run_s);
    return (std::abs(start_arcsec) + std::abs(end_arcsec)) / task.run_s;
}

// The terms that (7) has in print and corrected.
DriftTerms terms(const DriftCase& task, double interval_s, double quasi_nonmagnetic_arcsec_s) {
    return {.nonmagnetic_arcsec_s = std::abs(task.gyro.nonmagnetic_arcsec_s),
            .quasi_nonmagnetic_arcsec_s = std::abs(quasi_nonmagnetic_arcsec_s),
            .sawtooth_arcsec_s = sawtooth_arcsec_s(task, interval_s),
            .switch_errors_arcsec_s = task.switch_error_arcsec / interval_s};
}

}  // namespace

void check(const DriftCase& task) {
    check(task.gyro);
    require_positive(where, "switch_error_arcsec", task.switch_error_arcsec);
    require_positive(where, "run_s", task.run_s);
}

double quasi_nonmagnetic_arcsec_s(const GyroDrift& gyro, double run_s, double interval_s) {
    check(gyro);
    require_positive(where, "run_s", run_s);
    require_interval(interval_s, run_s);
    const double tau_s = gyro.thermal_time_s;
    return gyro.magnetic_thermal_arcsec_s * (tau_s / run_s) * std::tanh(interval_s / (2.0 * tau_s)) *
           -std::expm1(-run_s / tau_s);
}

double quasi_nonmagnetic_as_printed_arcsec_s(const GyroDrift& gyro, double interval_s) {
    check(gyro);
    require_positive(where, "interval_s", interval_s);
    const double tau_s = gyro.thermal_time_s;
    const double warmed = -std::expm1(-interval_s / tau_s);
    return gyro.magnetic_thermal_arcsec_s * tau_s / (2.0 * interval_s) * warmed * warmed;
}

DriftTerms corrected_terms(const DriftCase& task, double interval_s) {
    check(task, interval_s);
    return terms(task, interval_s, quasi_nonmagnetic_arcsec_s(task.gyro, task.run_s, interval_s));
}

DriftTerms terms_as_printed(const DriftCase& task, double interval_s) {
    check(task, interval_s);
    return terms(task, interval_s, quasi_nonmagnetic_as_printed_arcsec_s(task.gyro, interval_s));
}

double derivative_as_printed_arcsec_s2(const DriftCase& task, double interval_s) {
    check(task, interval_s);
    const double tau_s = task.gyro.thermal_time_s;
    const double thermal_arcsec_s = std::abs(task.gyro.magnetic_thermal_arcsec_s);
    const double left = std::exp(-interval_s / tau_s);
    const double warmed = -std::expm1(-interval_s / tau_s);
    const double falling_arcsec = thermal_arcsec_s * tau_s / 2.0 * warmed * warmed + task.switch_error_arcsec;
    return -falling_arcsec / (interval_s * interval_s) + thermal_arcsec_s / interval_s * warmed * left +
           std::abs(task.gyro.magnetic_arcsec_s) / task.run_s;
}

double worst_case_drift_arcsec_s(const DriftCase& task, double interval_s, FirstSegment first) {
    check(task, interval_s);
    return std::abs(task.gyro.nonmagnetic_arcsec_s) + worst_end_arcsec_s(task, interval_s, first) +
           task.switch_error_arcsec / interval_s;
}

double drift_bound_arcsec_s(const DriftCase& task, double interval_s) {
    check(task, interval_s);
    return std::abs(task.gyro.nonmagnetic_arcsec_s) +
           interval_s * std::abs(magnetic_rate_arcsec_s(task.gyro, task.run_s)) / task.run_s +
           task.switch_error_arcsec / interval_s;
}

double independent_switch_drift_arcsec_s(const DriftCase& task, double interval_s) {
    check(task, interval_s);
    return task.switch_error_arcsec / std::sqrt(task.run_s) / std::sqrt(interval_s);
}

double random_sign_drift_arcsec_s(const DriftCase& task, double interval_s, FirstSegment first) {
    return std::abs(task.gyro.nonmagnetic_arcsec_s) +
           std::hypot(independent_switch_drift_arcsec_s(task, interval_s), worst_end_arcsec_s(task, interval_s, first));
}

double expected_drift_arcsec_s(const DriftCase& task, double interval_s, FirstSegment first) {
    const double random_arcsec_s = independent_switch_drift_arcsec_s(task, interval_s);
    const double start_arcsec_s = start_residue_arcsec(task.gyro, interval_s, first) / task.run_s;
    const double end_arcsec_s = kernel_arcsec(task.gyro, interval_s, task.run_s) / task.run_s;
    return std::abs(task.gyro.nonmagnetic_arcsec_s) +
           std::hypot(random_arcsec_s, start_arcsec_s, end_arcsec_s / std::sqrt(3.0));
}

}  // namespace zlg::design
