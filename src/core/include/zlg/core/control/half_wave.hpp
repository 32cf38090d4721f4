#pragma once
// The stroke of the piezo against its voltage, learnt from the switches, and the voltage that the next move needs: a
// Prandtl-Ishlinskii model of hysteresis whose weights are estimated by a Kalman filter.
//
// Model. Length from the voltage v0 of the last move's start on, in wavelengths, U the presumed half-wave voltage:
//
//   L(v) = b + (w0 + k (T - T0)) (v - v0)/U + sum_i w_i (p_i(v) - p_i(v0))/U                             (1)
//   p_i  <- clip(p_i, v - r_i U, v + r_i U)      play operator of threshold r_i, for each reading v      (2)
//
// (1) is linear in the weights w = (w0, k, b, w_i): L = h^T w. Hysteresis is in w_i, temperature in k, and what does
// not turn with the direction in b. The thresholds r_i are a fixed grid, finer where a switch turns. Because the plays
// follow every reading, they hold the turning points and the path of the loop since the last switch (creep, warming),
// however long ago it was.
//
// Filter. The weights are a random walk, and each switch that ends in a lock is one measurement of L:
//
//   P += Q,  K = P h/(h^T P h + r),  w += K (L - h^T w),  P -= K h^T P                                   (3)
//
// Move. The voltage that moves by half a wavelength solves L(v) = +-1/2 by Newton's method with a fixed slope (4).
//
// Source: Kuhnen, Eur. J. Control 9 (2003) 407, for the operators; Kay, Estimation Theory, 1993, ch. 13, for the
// filter.
//
// Limit: two moves in a row in one direction, seldom and only when the gyro warms by whole modes, can miss by 0.015,
// because the weights of such a turn were never excited before.

#include <array>
#include <cstdint>

#include <zlg/core/common/maths.hpp>
#include <zlg/core/control/piezo_range.hpp>
#include <zlg/core/units.hpp>

namespace zlg::core {

inline constexpr std::size_t n_plays = 6;
inline constexpr std::size_t n_stroke_weights = n_plays + 3;  // w0, k, b, plays

struct HalfWaveConfig {
    PiezoRange range{};
    Volts half_wave{40.0};    // presumed, 1e-3..1e6 V
    Celsius reference{20.0};  // T0
};

[[nodiscard]] constexpr bool is_allowed(const HalfWaveConfig& c) noexcept {
    return is_allowed(c.range) && c.half_wave >= Volts{1e-3} && c.half_wave <= Volts{1e6} &&
           c.reference > Celsius{-1e6} && c.reference < Celsius{1e6};
}

using StrokeWeights = std::array<double, n_stroke_weights>;

// Voltages but `origin_v` are over U, counted from that of the start.
struct HalfWaveState {
    std::array<double, n_plays> play{};  // p_i
    double origin_v = 0.0;               // the start's voltage
    double start = 0.0;                  // v0 of the last move, and its plays
    std::array<double, n_plays> start_play{};
    StrokeWeights weight{};
    std::array<StrokeWeights, n_stroke_weights> covariance{};
    StrokeWeights regressor{};  // h of a move that has arrived and is not yet confirmed
    double length_lambda = 0.0;
    double length_sigma_lambda = 0.0;
    bool pending = false;
    double length_variance_lambda2 = 0.0;  // of a length as that of the last move, by now
    std::int8_t outlier_side = 0;  // of the last measurement: +1 moved too far for the gate, -1 too little; 0: inside

    friend constexpr bool operator==(const HalfWaveState&, const HalfWaveState&) = default;
};

[[nodiscard]] HalfWaveState initial_state(const HalfWaveConfig& config, Volts start) noexcept;

// Once every half-period: (2) with a reading of the piezo; an implausible one is ignored.
void follow(const HalfWaveConfig& config, HalfWaveState& state, Volts piezo) noexcept;

// The change of voltage, from `from` on, that is predicted to move the perimeter by half a wavelength.
//
// sign         +1 or -1, of the move.
// temperature  now; not finite: T0.
// return       of that sign, half to twice the presumed half-wave voltage.
// accuracy     1e-4 of U where the plays make up to a third of the stroke.
[[nodiscard]] Volts predicted_move(const HalfWaveConfig& config, const HalfWaveState& state, std::int8_t sign,
                                   Volts from, Celsius temperature) noexcept;

// A move begins, from the settled voltage `from`.
void begin_move(const HalfWaveConfig& config, HalfWaveState& state, Volts from) noexcept;

// The move has arrived, in whatever mode: keep the measurement until the lock shows the mode.
//
// sign      of the move.
// piezo     at its end; the plays have followed it.
// detuning  there, from the centre of the neighbouring mode.
void arrive(const HalfWaveConfig& config, HalfWaveState& state, std::int8_t sign, Volts piezo, Wavelengths detuning,
            Celsius temperature) noexcept;

// One standard deviation of the half-wave voltage, of which `half_wave` is the present value.
[[nodiscard]] inline Volts sigma(const HalfWaveState& s, Volts half_wave) noexcept {
    return 2.0 * square_root(s.length_variance_lambda2) * half_wave;
}

// The lock shows whether the mode is the neighbour's. If so, the measurement update (3) with
//
//   h: `regressor`,  r = (0.001 wavelength)^2 + (miss/10)^2
//
// A second outlier in a row on the same side is accepted: the piezo has changed, and P restarts from its prior.
//
// return  false for an outlier, from which nothing is learnt.
bool confirm(HalfWaveState& state, bool neighbour) noexcept;

}  // namespace zlg::core
