#pragma once
// The angle of an alternating sequence of segments by its definition: the sum of the integrals of the magnetic drift,
// against which the closed forms are tested.

#include <zlg/design/magnetic_angle.hpp>

#include "test.hpp"

namespace zlg::design {

// Lengths of the segments of a run: L or L/2, then L, the last one cut where the run ends. One that ends at a switch,
// but for rounding, has no splinter of a segment behind it.
inline std::vector<double> segments_s(double interval_s, FirstSegment first, double run_s) {
    const double first_s = first == FirstSegment::half ? interval_s / 2.0 : interval_s;
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

// The first segment has the sign +.
inline double end_error_arcsec(const GyroDrift& gyro, std::span<const double> segments_s) {
    double angle_arcsec = 0.0;
    double begin_s = 0.0;
    double sign = 1.0;
    for (const double length_s : segments_s) {
        const double end_s = begin_s + length_s;
        angle_arcsec += sign * magnetic_integral_arcsec(gyro, begin_s, end_s);
        begin_s = end_s;
        sign = -sign;
    }
    return angle_arcsec;
}

// S - (-1)^n K[Om](t), t = n L (first segment full) or (n - 1/2) L (half): the closed form at the end of segment n
// >= 1.
inline double angle_after_segments_arcsec(const GyroDrift& gyro, double interval_s, FirstSegment first,
                                          int n_segments) {
    const double end_s = (n_segments - (first == FirstSegment::half ? 0.5 : 0.0)) * interval_s;
    const double kernel = kernel_arcsec(gyro, interval_s, end_s);
    return start_residue_arcsec(gyro, interval_s, first) + (n_segments % 2 == 0 ? -kernel : kernel);
}

}  // namespace zlg::design
