#include <cmath>
#include <limits>
#include <numbers>

#include <zlg/design/interval_formula.hpp>

#include "range_check.hpp"

namespace zlg::design {

namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

// Positive roots of p L^3 - q L^2 + 1 = 0, p, q >= 0.
//
// With y = 1/(L sqrt q) it reads y - y^3 = p q^(-3/2); with y = (2/sqrt 3) sin(phi), sin(3 phi) = (3 sqrt 3/2) p
// q^(-3/2).
Roots positive_roots(double p, double q, double run_s) {
    const double sine = 1.5 * std::numbers::sqrt3 * (p / q) / std::sqrt(q);
    if (!(q > 0.0 && sine <= 1.0)) return {RootStatus::none, nan_value, nan_value};
    const double small_phi = std::asin(sine) / 3.0;
    const double large_phi = std::numbers::pi / 3.0 - small_phi;
    const double unit_s = std::numbers::sqrt3 / (2.0 * std::sqrt(q));
    const double smaller_s = unit_s / std::sin(large_phi);
    const double larger_s = unit_s / std::sin(small_phi);
    return {smaller_s <= run_s ? RootStatus::found : RootStatus::beyond_run, smaller_s, larger_s};
}

}  // namespace

double closed_form_interval_s(const DriftCase& task) {
    check(task);
    return std::sqrt(task.switch_error_arcsec * task.run_s / std::abs(task.gyro.magnetic_arcsec_s));
}

double random_sign_interval_s(const DriftCase& task, FirstSegment first) {
    check(task);
    const double start_arcsec_s = first == FirstSegment::full ? std::abs(task.gyro.magnetic_arcsec_s) : 0.0;
    const double end_arcsec_s = std::abs(magnetic_rate_arcsec_s(task.gyro, task.run_s));
    const double ratio_s = task.switch_error_arcsec / (0.5 * (start_arcsec_s + end_arcsec_s));
    return std::cbrt(ratio_s * ratio_s * task.run_s / 2.0);
}

Roots corrected_roots(const DriftCase& task) {
    check(task);
    const double thermal_arcsec_s = std::abs(task.gyro.magnetic_thermal_arcsec_s);
    const double tau_s = task.gyro.thermal_time_s;
    const double dp_arcsec = task.switch_error_arcsec;
    // Both sides divided by 2 tau^2 t dP.
    const double p = thermal_arcsec_s / (tau_s * tau_s * dp_arcsec);
    const double q =
        (std::abs(task.gyro.magnetic_arcsec_s) / task.run_s + thermal_arcsec_s / (2.0 * tau_s)) / dp_arcsec;
    return positive_roots(p, q, task.run_s);
}

Roots roots_as_printed(const DriftCase& task) {
    check(task);
    const double tau_s = task.gyro.thermal_time_s;
    const double dp_arcsec = task.switch_error_arcsec;
    const double p = std::abs(task.gyro.magnetic_thermal_arcsec_s) / (2.0 * tau_s * tau_s * dp_arcsec);
    const double q = std::abs(task.gyro.magnetic_arcsec_s) / (task.run_s * dp_arcsec);
    return positive_roots(p, q, task.run_s);
}

double longest_run_as_printed_s(const GyroDrift& gyro, double switch_error_arcsec) {
    check(gyro);
    require_positive("interval formula", "switch_error_arcsec", switch_error_arcsec);
    const double om0_arcsec_s = std::abs(gyro.magnetic_arcsec_s);
    const double ratio = gyro.thermal_time_s * gyro.thermal_time_s / gyro.magnetic_thermal_arcsec_s;
    return std::cbrt(16.0 * ratio * ratio * om0_arcsec_s * om0_arcsec_s * om0_arcsec_s / (27.0 * switch_error_arcsec));
}

}  // namespace zlg::design
