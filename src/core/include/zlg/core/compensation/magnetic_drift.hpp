#pragma once
// The drift that changes its sign with the mode: estimated from segment to segment, and subtracted from the angle.
//
// Segment k, in mode m_k = +1 or -1, has the mean rate
//
//   y_k = b_k + m_k Om(t_k) + noise                                                                      (1)
//
// b the rotation of the base with all drift that is the same in both modes, unknown, and Om the magnetic drift. Where b
// changes little from one segment to the next, the alternation of y shows Om. A Kalman filter holds
//
//   b      a random walk over the segments, whose step is estimated from the innovations (adaptive process noise)
//   Om, v  Om' = v, v' = -v/thermal_time: exact for a warming A (1 - exp(-t/thermal_time)), other laws by process noise
//   M      M' = m Om, the magnetic angle since the start                                                 (2)
//
// with (1) as its measurement. M is correlated with Om, so each segment corrects M for the whole past as well: what was
// subtracted wrongly while Om was badly known does not stay. The share `trust` of M is subtracted from the measured
// ticks, a correction of the past over some seconds.
//
// Method: Kalman filter with augmented states and innovation-based adaptation (Maybeck, Stochastic Models, Estimation
// and Control, vol. 2, 1982, ch. 10). Figures: docs/long_runs.md.

#include <cstdint>

#include <zlg/core/compensation/compensation_constants.hpp>
#include <zlg/core/compensation/magnetic_filter.hpp>
#include <zlg/core/compensation/segment_rate.hpp>
#include <zlg/core/units.hpp>

namespace zlg::core {

enum class MagneticMethod : unsigned char {
    none,
    watch,     // estimate, but leave the angle alone
    estimate,  // estimate, and subtract from the angle
};

struct MagneticDriftConfig {
    MagneticMethod method = MagneticMethod::none;
    double presumed_arcsec_s = 0.0;        // Om at the start, by calibration, and its standard deviation
    double presumed_sigma_arcsec_s = 1.0;  // >= 0
    double warming_arcsec_s = 0.0;         // A: growth of Om in operation, and its standard deviation
    double warming_sigma_arcsec_s = 1.0;   // >= 0
    Seconds thermal_time{3000.0};          // > 0
};

enum class MagneticDriftFault : unsigned char { none, presumed, warming };

// Asked whatever the method: by phase every one uses the numbers.
[[nodiscard]] MagneticDriftFault check(const MagneticDriftConfig& config) noexcept;

struct MagneticDriftState {
    bool started = false;
    SegmentRateState segment{};
    std::int8_t mode = 0;            // of the last tick; 0 in a gap
    std::int32_t pending_ticks = 0;  // since the filter was at the present
    std::int8_t last_mode = 0;       // that was measured
    double age_s = 0.0;              // of the filter
    double switched_s = 0.0;         // age at the last switch; 0: none yet
    MagneticFilterState filter{};
    double share = 0.0;              // 0..1: (3)
    double trust = 0.0;              // 0..1: (3), the part of M that is subtracted
    double due_arcsec = 0.0;         // trust M, by now
    double subtracted_arcsec = 0.0;  // so far

    friend constexpr bool operator==(const MagneticDriftState&, const MagneticDriftState&) = default;
};

struct MagneticTick {
    bool measured = true;
    std::int8_t mode = 1;
    double angle_arcsec = 0.0;  // as read, re-lock corrected
};

// Advance by one tick. A gap, or a change of the mode, ends a segment.
//
//   share = 1 - 16 sigma^2/Om^2, not below 0;    trust = share where Om is within 2 sigma_p of what was presumed,
//   0 beyond 3 sigma_p, by the square of the distance between                                            (3)
//
// so it acts only where the drift is known to a quarter of itself: base motion that looks like drift increases the
// scatter of the innovations, and that increases sigma; so does motion in step with the switches (motion_in_step.hpp). A
// rotation in step that jumps with the switches is bounded by sigma_p alone, the standard deviation of the presumed drift,
// of its warming by now and of its random walk. Segments whose rate scatters by more than 300 arcsec/s are not used.
//
// config  passed `check`.
// state   from MagneticDriftState{}.
// return  the angle to subtract from this tick, arcsec: 0 in a gap, and where the method does not act.
// errors  an angle that is not finite, or of a rate above 1e7 arcsec/s, ends the segment, which is dropped.
// cost    ten multiplications a tick; every 1024 ticks, and where a segment ends, products of 4 x 4 matrices.
[[nodiscard]] double step(const CompensationConstants& gyro, const MagneticDriftConfig& config,
                          MagneticDriftState& state, const MagneticTick& tick) noexcept;

// The rate that alternates with the mode, drift or motion in step, as far as the filter knows it: its estimate times
// 1 - 16 sigma^2/Om^2, sigma that of the filter alone, whatever the method and what was presumed.
[[nodiscard]] double trusted_arcsec_s(const MagneticDriftState& state) noexcept;

// Standard deviation of the drift: that of (3), with what a rotation in step could be unseen (motion_in_step.hpp). On a
// regular grid that is all that was presumed, and the distance from it; where the two contradict each other, sigma spans
// both.
[[nodiscard]] double sigma_arcsec_s(const MagneticDriftConfig& config, const MagneticDriftState& state) noexcept;

// The drift that remains in the angle, rms: all of it where nothing is subtracted. As a schedule asks for it, that is without
// what could be there unseen.
//
// return  arcsec/s; 0 before the drift is known to a quarter of itself.
[[nodiscard]] double remaining_arcsec_s(const MagneticDriftConfig& config, const MagneticDriftState& state) noexcept;

}  // namespace zlg::core
