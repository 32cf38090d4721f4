#pragma once
// The drift that changes its sign with the mode: learnt from segment to segment, and taken out of the angle.
//
// Segment k, in mode m_k = +1 or -1, has the mean rate
//
//   y_k = b_k + m_k Om(t_k) + noise
//
// b the rotation of the base with all drift that is the same in both modes, unknown, and Om the magnetic drift. Where b
// changes little from one segment to the next, the alternation of y shows Om. A Kalman filter holds
//
//   b      moves at random; how much, the scatter of the innovations tells
//   Om, v  Om' = v, v' = -v/thermal_time: exact for a warming A (1 - exp(-t/thermal_time)), other laws by its noise
//   M      M' = m Om, the magnetic angle since the start
//
// so each segment corrects M for the whole past as well, and the angle is the best that is known by now: what was wrongly
// subtracted while Om was badly known does not stay. M, as far as it is trusted, is taken out of the measured ticks, a
// correction of the past over some seconds.

#include <array>
#include <cstdint>

#include <zlg/core/compensation/segment_rate.hpp>
#include <zlg/core/units.hpp>

namespace zlg::core {

enum class MagneticMethod : unsigned char {
    none,
    watch,     // learn, but leave the angle alone
    estimate,  // learn, and take it out of the angle
};

struct MagneticDriftConfig {
    MagneticMethod method = MagneticMethod::none;
    Seconds tick{0.005};                    // > 0
    ArcsecPerRootSecond walk{0.14};         // of the angle, >= 0
    Arcsec count{3.263};                    // >= 0
    double presumed_arcsec_s = 0.0;         // Om at the start, by calibration, and its standard deviation
    double presumed_sigma_arcsec_s = 10.0;  // >= 0
    double warming_arcsec_s = 0.0;          // A: growth of Om in operation, and its standard deviation
    double warming_sigma_arcsec_s = 10.0;   // >= 0
    Seconds thermal_time{3000.0};           // > 0
};

enum class MagneticDriftFault : unsigned char { none, tick, noise, presumed, warming };

// Of `none`, which uses no number, nothing is asked.
[[nodiscard]] MagneticDriftFault check(const MagneticDriftConfig& config) noexcept;

enum MagneticPart : unsigned char { of_base, of_drift, of_trend, of_angle, magnetic_parts };

using MagneticVector = std::array<double, magnetic_parts>;
using MagneticCovariance = std::array<MagneticVector, magnetic_parts>;

struct MagneticDriftState {
    bool started = false;
    SegmentRateState segment{};
    std::int8_t mode = 0;            // of the last tick; 0 in a gap
    std::int32_t pending_ticks = 0;  // since `estimate` was valid
    bool base_known = false;
    MagneticVector estimate{};  // b and Om in arcsec/s, v in arcsec/s^2, M in arcsec
    MagneticCovariance covariance{};
    std::int32_t n_compared = 0;     // segments that have met a prediction
    double scatter_arcsec_s = 0.0;   // of the innovations, beyond what noise explains
    double trust = 0.0;              // 0..1: the part of M that is taken out
    double due_arcsec = 0.0;         // trust M, by now
    double subtracted_arcsec = 0.0;  // so far

    friend constexpr bool operator==(const MagneticDriftState&, const MagneticDriftState&) = default;
};

struct MagneticTick {
    bool measured = true;
    std::int8_t mode = 1;
    double angle_arcsec = 0.0;  // as read, re-lock corrected
};

// Take one tick. A gap, or a change of the mode, ends a segment.
//
//   trust = 1 - 16 sigma^2/Om^2, not below 0
//
// so that it acts only where it knows the drift to a quarter of itself: base motion that looks like drift shows in the
// scatter, the scatter in sigma. Segments whose rate scatters by more than 300 arcsec/s are not listened to at all.
//
// config  passed `check`.
// state   from MagneticDriftState{}.
// return  the angle to subtract from this tick, arcsec: 0 in a gap, and where the method does not act.
// errors  an angle that is not finite, or of a rate above 1e7 arcsec/s, ends the segment, which is dropped.
// cost    ten multiplications a tick; every 1024 ticks, and where a segment ends, products of 4 x 4 matrices.
[[nodiscard]] double step(const MagneticDriftConfig& config, MagneticDriftState& state,
                          const MagneticTick& tick) noexcept;

[[nodiscard]] double sigma_arcsec_s(const MagneticDriftState& state) noexcept;

// What of the drift the angle still has in it, rms: all of it where nothing is subtracted.
//
// return  arcsec/s; 0 before the drift is known to a quarter of itself.
[[nodiscard]] double remaining_arcsec_s(const MagneticDriftConfig& config, const MagneticDriftState& state) noexcept;

}  // namespace zlg::core
