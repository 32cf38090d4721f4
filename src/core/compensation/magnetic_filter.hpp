#pragma once
// The Kalman filter behind the magnetic drift.

#include <zlg/core/compensation/magnetic_drift.hpp>

namespace zlg::core {

// Of the base from segment to segment, before it was seen.
inline constexpr double presumed_scatter_arcsec_s = 0.5;

// Advance by `time_s` in the mode of the state.
void predict(MagneticDriftState& state, double time_s, double thermal_time_s) noexcept;

struct Segment {
    double mode = 1.0;
    double length_s = 0.0;
    SegmentRate rate{};
    double variance = 0.0;  // of its mean, without motion of the base
};

// Take the rate of the segment that has just ended.
void update(MagneticDriftState& state, const Segment& segment) noexcept;

}  // namespace zlg::core
