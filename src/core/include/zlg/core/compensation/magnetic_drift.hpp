#pragma once
// The drift that changes its sign with the mode: estimated from segment to segment, and subtracted from the angle.
//
// Segment k, in mode m_k = +1 or -1, of length L, has the mean rate (segment_rate.hpp)
//
//   y_k = b_k + m_k (Om - v L/2) + noise,  variance r_k                                                          (1)
//
// Om and v at its end, b the rotation of the base with all drift that is the same in both modes. Where b changes little
// from one segment to the next, the alternation of y shows Om. A Kalman filter has the states
//
//   b      steps from segment to segment, by a variance of twice the larger of s^2 and u_k^2: u_k the motion of the
//          base, that is the innovation or the curvature of the rate in segment k beyond what noise and P explain, s
//          its running mean                                                                                        (2)
//   Om, v  Om' = v, v' = -v/thermal_time: exact for a warming A (1 - exp(-t/thermal_time)), other laws by process noise
//
// and M, M' = m Om, the magnetic angle since the start: not a state, but its covariance with the states is known, so
// that each segment corrects it for the whole past. What was subtracted wrongly while Om was badly known does not stay.
//
// A rotation of the base that turns its sign with the mode has the mean rates of a drift, but a drift is steady within
// a segment, and its innovations do not alternate. With c_k = m_k times half the innovation, or times the curvature of
// the rate in segment k, and w_k = 1/r_k, older segments fading over 32,
//
//   C = sum w_k c_k/sum w_k,   Var C = sum (w_k c_k)^2/(sum w_k)^2,
//   sigma^2 = P of Om + 16 sum over both of max(C^2 - 16 Var C, 0)                                               (3)
//
// What is not in step leaves a C within a few of its standard deviations. The mean rate of a sine is about as large as
// its C, that of a square wave that jumps 0.08 of a segment beside the switch four times as large: four times is
// presumed.
//
// Method: Kalman filter with innovation-based adaptation (Maybeck, Stochastic Models, Estimation and Control, vol. 2,
// 1982, ch. 10); self-normalised sums (de la Pena, Lai and Shao, 2009). Figures: docs/drift.md.

#include <array>
#include <cstdint>

#include <zlg/core/compensation/compensation_constants.hpp>
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

// Asked whatever the method: by phase every one uses the numbers.
[[nodiscard]] bool is_allowed(const MagneticDriftConfig& config) noexcept;

enum MagneticPart : unsigned char { of_base, of_drift, of_trend, of_angle };

inline constexpr unsigned magnetic_states = 3;
inline constexpr unsigned magnetic_parts = 4;

using MagneticVector = std::array<double, magnetic_states>;

struct MagneticDriftState {
    bool started = false;
    SegmentRateState segment{};
    std::int8_t mode = 0;                                     // of the last tick; 0 in a gap
    std::int32_t pending_ticks = 0;                           // since the filter was at the present
    double age_s = 0.0;                                       // of the filter
    bool base_known = false;                                  // by the last segment
    std::array<double, magnetic_parts> estimate{};            // b, Om: arcsec/s, v: arcsec/s^2, M: arcsec
    std::array<MagneticVector, magnetic_parts> covariance{};  // of each with the states
    double n_compared = 2.0;                                  // segments that s stands for
    double scatter_arcsec_s = 0.5;                            // s of (2); at first that of a quiet laboratory
    double weight = 0.0;                                      // sum of w of (3)
    std::array<double, 2> sum{};                              // of w c
    std::array<double, 2> square_sum{};                       // of (w c)^2
    double trust = 0.0;                                       // 0..1: (4)
    double subtracted_arcsec = 0.0;                           // so far

    friend constexpr bool operator==(const MagneticDriftState&, const MagneticDriftState&) = default;
};

struct MagneticTick {
    bool measured = true;
    std::int8_t mode = 1;
    double angle_arcsec = 0.0;  // as read, re-lock corrected
};

// Advance by one tick. A gap, or a change of the mode, ends a segment.
//
//   angle subtracted = trust M,
//   trust = 1 - 16 sigma^2/Om^2 - (d^2 - 4 sigma_p^2)/(5 sigma_p^2), each at least 0                             (4)
//
// with d the distance of Om from what was presumed, sigma_p the standard deviation of the presumed drift, of its
// warming by now and of its random walk. So it acts where the drift is known to a quarter of itself and lies within
// 2 sigma_p of what was presumed; beyond 3 sigma_p it does not. What trust and M were wrong by in the past is
// corrected over some seconds. Segments between which the base changes by more than 300 arcsec/s are not compared.
//
// config  passed `check`.
// state   from MagneticDriftState{}.
// return  the angle to subtract from this tick, arcsec: 0 in a gap, and where the method does not act.
// errors  an angle that is not finite, or of a rate above 1e7 arcsec/s, ends the segment, which is dropped.
// cost    some 14 multiplications a tick; every 1024 ticks, and where a segment ends, some 100.
[[nodiscard]] double step(const CompensationConstants& gyro, const MagneticDriftConfig& config,
                          MagneticDriftState& state, const MagneticTick& tick) noexcept;

// The same of so many measured ticks of the segment that goes on, whose angle comes evenly; ticks >= 1.
//
// return  the angle to subtract from all of them.
// cost    that of a tick, and 1/1024 of it for each.
[[nodiscard]] double leap(const CompensationConstants& gyro, const MagneticDriftConfig& config,
                          MagneticDriftState& state, std::int64_t ticks, double angle_arcsec) noexcept;

// The part of Om that is subtracted.
[[nodiscard]] constexpr double taken_out(const MagneticDriftConfig& config, const MagneticDriftState& state) noexcept {
    return config.method == MagneticMethod::estimate ? state.trust : 0.0;
}

// sigma^2 of (3), (arcsec/s)^2.
[[nodiscard]] double drift_variance(const MagneticDriftState& state) noexcept;

// The drift that remains in the angle, rms, arcsec/s; 0 where it is not trusted, and a schedule presumes one.
[[nodiscard]] double remaining_arcsec_s(const MagneticDriftConfig& config, const MagneticDriftState& state) noexcept;

}  // namespace zlg::core
