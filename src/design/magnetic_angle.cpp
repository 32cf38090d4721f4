#include <cmath>
#include <string_view>

#include <zlg/design/magnetic_angle.hpp>

#include "range_check.hpp"

namespace zlg::design {

namespace {

constexpr std::string_view where = "magnetic angle";

// The part of A that is still to come at t.
double thermal_rest_arcsec_s(const GyroDrift& gyro, double at_s) {
    return gyro.magnetic_thermal_arcsec_s * std::exp(-at_s / gyro.thermal_time_s);
}

}  // namespace

void check(const GyroDrift& gyro) {
    require_finite(where, "nonmagnetic_arcsec_s", gyro.nonmagnetic_arcsec_s);
    require_finite(where, "magnetic_arcsec_s", gyro.magnetic_arcsec_s);
    require_finite(where, "magnetic_thermal_arcsec_s", gyro.magnetic_thermal_arcsec_s);
    require_positive(where, "thermal_time_s", gyro.thermal_time_s);
}

double magnetic_rate_arcsec_s(const GyroDrift& gyro, double at_s) {
    return gyro.magnetic_arcsec_s - gyro.magnetic_thermal_arcsec_s * std::expm1(-at_s / gyro.thermal_time_s);
}

double magnetic_integral_arcsec(const GyroDrift& gyro, double from_s, double to_s) {
    const double length_s = to_s - from_s;
    const double tau_s = gyro.thermal_time_s;
    // The rate at the start for the whole segment, and what warming adds within it.
    return magnetic_rate_arcsec_s(gyro, from_s) * length_s +
           thermal_rest_arcsec_s(gyro, from_s) * (length_s + tau_s * std::expm1(-length_s / tau_s));
}

double kernel_arcsec(const GyroDrift& gyro, double interval_s, double at_s) {
    const double half_s = interval_s / 2.0;
    const double tau_s = gyro.thermal_time_s;
    // K[1] = L/2 for all of Om(t), and for its exponential part the difference to the kernel's true value.
    return magnetic_rate_arcsec_s(gyro, at_s) * half_s +
           thermal_rest_arcsec_s(gyro, at_s) * (half_s - tau_s * std::tanh(half_s / tau_s));
}

double start_residue_arcsec(const GyroDrift& gyro, double interval_s, FirstSegment first) {
    if (first == FirstSegment::full) return kernel_arcsec(gyro, interval_s, 0.0);
    const double tau_s = gyro.thermal_time_s;
    return -gyro.magnetic_thermal_arcsec_s * tau_s * std::tanh(interval_s / (2.0 * tau_s)) *
           std::tanh(interval_s / (4.0 * tau_s));
}

}  // namespace zlg::design
