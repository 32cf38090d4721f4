#include <cmath>

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include <zlg/design/growing_interval.hpp>

#include "range_check.hpp"

namespace zlg::design {

namespace {

void check(const DriftCase& task, double growth) {
    check(task);
    require_positive("growing interval", "growth", growth);
}

}  // namespace

double growing_interval_s(const DriftCase& task, double growth) {
    check(task, growth);
    const double om_arcsec_s = std::abs(magnetic_rate_arcsec_s(task.gyro, task.run_s));
    return growth * std::sqrt(task.switch_error_arcsec * task.run_s / om_arcsec_s);
}

double growing_switches(const DriftCase& task, double growth) {
    check(task, growth);
    // With t' = v^2 the integrand 1/L(t') has no pole at the start.
    const auto root_om = [&](double v) { return std::sqrt(std::abs(magnetic_rate_arcsec_s(task.gyro, v * v))); };
    constexpr unsigned max_depth = 12;
    constexpr double tolerance = 1e-10;
    const double integral = boost::math::quadrature::gauss_kronrod<double, 31>::integrate(
        root_om, 0.0, std::sqrt(task.run_s), max_depth, tolerance);
    return 2.0 * integral / (growth * std::sqrt(task.switch_error_arcsec));
}

double growing_drift_arcsec_s(const DriftCase& task, double growth) {
    check(task, growth);
    const double om_arcsec_s = std::abs(magnetic_rate_arcsec_s(task.gyro, task.run_s));
    // L Om/2 written without the division by an Om that may be 0.
    const double sawtooth_arcsec = growth / 2.0 * std::sqrt(task.switch_error_arcsec * task.run_s * om_arcsec_s);
    const double switches_arcsec = growing_switches(task, growth) * task.switch_error_arcsec;
    return std::abs(task.gyro.nonmagnetic_arcsec_s) + (sawtooth_arcsec + switches_arcsec) / task.run_s;
}

}  // namespace zlg::design
