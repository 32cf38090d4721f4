#pragma once
// The Kalman filter behind the magnetic drift: x = (b, Om, v, M), equations (1) and (2) of magnetic_drift.hpp.
//
//   predict, time s      x <- F x, P <- F P F^T + Q s                                                    (4)
//   update, segment of   y = h^T x + noise,  h = (1, m, -m L/2, 0): the rate at the middle of a segment of length L
//                        P_bb += step^2,  K = P h/(h^T P h + r),  x <- x + K (y - h^T x),  P <- P - K h^T P  (5)

#include <array>
#include <cstdint>

#include <zlg/core/compensation/motion_in_step.hpp>
#include <zlg/core/compensation/segment_rate.hpp>

namespace zlg::core {

enum MagneticPart : unsigned char { of_base, of_drift, of_trend, of_angle, magnetic_parts };

using MagneticVector = std::array<double, magnetic_parts>;
using MagneticCovariance = std::array<MagneticVector, magnetic_parts>;

// Scatter of the base from segment to segment, before any is known: a quiet laboratory. The first segments replace it.
inline constexpr double presumed_scatter_arcsec_s = 0.5;

struct MagneticFilterState {
    bool base_known = false;
    MagneticVector estimate{};  // b and Om in arcsec/s, v in arcsec/s^2, M in arcsec
    MagneticCovariance covariance{};
    std::int32_t n_compared = 0;                          // segments that were compared with a prediction
    double scatter_arcsec_s = presumed_scatter_arcsec_s;  // of the innovations, beyond what noise explains
    MotionInStepState in_step{};

    friend constexpr bool operator==(const MagneticFilterState&, const MagneticFilterState&) = default;
};

// Advance by `time_s` in one mode, +1 or -1; 0 in a gap, where M stays.
void predict(MagneticFilterState& state, std::int8_t mode, double time_s, double thermal_time_s) noexcept;

// Variance that Q adds to Om in `time_s`, nearly.
[[nodiscard]] double wander_variance(double time_s, double thermal_time_s) noexcept;

struct Segment {
    double mode = 1.0;
    double length_s = 0.0;
    SegmentRate rate{};
    double variance = 0.0;  // of its mean, without motion of the base
};

// (5) with the rate of the segment that has just ended.
void update(MagneticFilterState& state, const Segment& segment) noexcept;

}  // namespace zlg::core
