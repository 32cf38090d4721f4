#include <cmath>
#include <cstddef>
#include <string_view>
#include <zlg/design/magnetic_angle.hpp>

#include "range_check.hpp"

namespace zlg::design {

namespace {

constexpr std::string_view where = "magnetic angle";
constexpr double max_segments = 1e7;

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

double kernel_series_arcsec(const GyroDrift& gyro, double interval_s, double at_s) {
    const double tau_s = gyro.thermal_time_s;
    const double second_derivative = -thermal_rest_arcsec_s(gyro, at_s) / (tau_s * tau_s);
    return magnetic_rate_arcsec_s(gyro, at_s) * interval_s / 2.0 -
           second_derivative * interval_s * interval_s * interval_s / 24.0;
}

double start_residue_arcsec(const GyroDrift& gyro, double interval_s, FirstSegment first) {
    if (first == FirstSegment::full) return kernel_arcsec(gyro, interval_s, 0.0);
    const double tau_s = gyro.thermal_time_s;
    return -gyro.magnetic_thermal_arcsec_s * tau_s * std::tanh(interval_s / (2.0 * tau_s)) *
           std::tanh(interval_s / (4.0 * tau_s));
}

double angle_after_segments_arcsec(const GyroDrift& gyro, double interval_s, FirstSegment first,
                                   std::int64_t n_segments) {
    require_positive(where, "interval_s", interval_s);
    require(n_segments >= 1, where, "n_segments", static_cast<double>(n_segments), "1 and above");
    const double missing = first == FirstSegment::half ? 0.5 : 0.0;
    const double end_s = (static_cast<double>(n_segments) - missing) * interval_s;
    const double kernel = kernel_arcsec(gyro, interval_s, end_s);
    return start_residue_arcsec(gyro, interval_s, first) + (n_segments % 2 == 0 ? -kernel : kernel);
}

std::vector<double> segments_s(double interval_s, FirstSegment first, double run_s) {
    require_positive(where, "interval_s", interval_s);
    require_positive(where, "run_s", run_s);
    require(run_s / interval_s < max_segments, where, "run_s / interval_s", run_s / interval_s, "below 1e7");
    const double first_s = first == FirstSegment::half ? interval_s / 2.0 : interval_s;
    // A run that ends at a switch, but for rounding, has no splinter of a segment behind it.
    const double min_s = 1e-9 * interval_s;
    std::vector<double> lengths;
    double begin_s = 0.0;
    while (run_s - begin_s > min_s) {
        const double end_s = first_s + static_cast<double>(lengths.size()) * interval_s;
        lengths.push_back(end_s < run_s + min_s ? end_s - begin_s : run_s - begin_s);
        begin_s = end_s;
    }
    return lengths;
}

double end_error_arcsec(const GyroDrift& gyro, std::span<const double> segments_s) {
    double angle_arcsec = 0.0;
    double begin_s = 0.0;
    double sign = 1.0;
    for (const double length_s : segments_s) {
        require_not_negative(where, "segments_s", length_s);
        const double end_s = begin_s + length_s;
        angle_arcsec += sign * magnetic_integral_arcsec(gyro, begin_s, end_s);
        begin_s = end_s;
        sign = -sign;
    }
    return angle_arcsec;
}

}  // namespace zlg::design
