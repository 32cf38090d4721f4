#pragma once
// Balance of the two photodiodes: the constant inequality of the beams is learnt and taken off before anything is
// judged.
//
// The light signal S = (A - B)/(A + B) is the detuning, whose sign turns with the bias, and what the photodiodes are
// unequal by, which does not turn. With w (B - o) in place of B, for the two halves of a tick and the means a and b of
// the beams,
//
//   (S_1 + S_2)/2 = (a - w (b - o))/(a + w (b - o))                                                (1)
//
// and w is led to where this is 0, as a mean over 100 ticks in which the detuning stands, that drifts with it.
//
// An offset is a part of the light that does not fall with it: far from the centre, where the light P = A + w (B - o)
// is less than its level P_0, it is seen as a jump of the detuning where the bias is reversed. An offset of w P_0/2
// makes the jump
//
//   h = F'/K (P_0/P - 1 + S^2)                                                                     (2)
//
// by which o, of which only the difference of both beams matters, is learnt in every re-lock: Kalman's filter of one
// state. A bend of the way at the reversals, of the steps of a digital loop, makes jumps that alternate and fall as S:
// of each jump and S/S' times the one before, that is free of them.
//
// A slower mean of w follows it. A weight that has left it by more than 1.33 % has drifted by that within
// `balance_ticks` of the limits, by .2 an hour where these are 4 minutes: a fault of a photodiode or of a beam,
// although the detuning is still read.

#include <cstdint>

#include <zlg/core/control/light_monitor.hpp>

namespace zlg::core {

// Jump J of the detuning where the bias was reversed.
struct SeenJump {
    double lambda = 0.0;
    double per_offset = 0.0;        // h
    double variance_lambda2 = 0.0;  // r
    double signal_sq = 0.0;         // S^2 there
    double behind = 2.0;            // S of the half behind it

    friend constexpr bool operator==(const SeenJump&, const SeenJump&) = default;
};

struct LightBalanceState {
    double weight = 1.0;                // of beam B
    double slow_weight = 1.0;           // its mean
    double drift = 0.0;                 // of ln w, half of it, from one tick that teaches to the next
    double level = 0.0;                 // P_0
    double offset = 0.0;                // of beam B, in the unit of the samples
    double variance = 1e-7;             // of that, in units of w P_0/2
    double jumps = 0.0, weights = 0.0;  // sums of h J/r and h^2/r of recent ones
    SeenJump seen{};                    // the last one
    double n_ticks = 0.0;               // that were learnt from, up to `balance_ticks`
    std::int32_t n_faded = 0;           // ticks in a row, of those that are followed, in which a beam had faded
    bool changes = false;               // the balance has changed
    bool has_last = false;              // the half before was read:
    double last_signal = 0.0;           // its S
    double last_light = 0.0;            // and P
    double former_signal = 1.0;         // S of the one before

    friend constexpr bool operator==(const LightBalanceState&, const LightBalanceState&) = default;
};

[[nodiscard]] constexpr BeamWeight weight_of(const LightBalanceState& state) noexcept {
    return {state.weight, state.weight * state.offset};
}

// Ticks before which w is not known to a part of 1e-4: a jump is then that of the gains.
inline constexpr double known_ticks = 40.0;

[[nodiscard]] constexpr bool is_learning(const LightBalanceState& state) noexcept {
    return (state.n_ticks > 0.0 || state.has_last) && state.n_ticks < known_ticks;
}

// Ticks of the mean of w, and those after which it is compared with the slower one: of a settled gyro, of which one in
// four is learnt from, 2 s of 5 ms. A hundredth of the noise of a half is then left in w.
inline constexpr double balance_memory_ticks = 100.0;
inline constexpr std::int64_t halves_a_lesson = 8;

// By which w is led on from tick to tick, so that no even drift is left in it: both at once as quickly as can be
// without swinging, a double pole at 1 - 1/200.
inline constexpr double balance_drift_gain = 0.25 / (balance_memory_ticks * balance_memory_ticks);

// One half of balanced light, its means.
struct BalancedHalf {
    bool is_first = false;   // of its tick
    bool is_read = false;    // it was closed, lit both ways, and followed the half before
    bool settles = false;    // the loop has not locked yet: once w is known, it is not learnt there
    bool has_faded = false;  // by the monitor: a beam against the other
    double signal = 0.0;     // S
    double light = 0.0;      // P
};

// Variance of the jump of the detuning from the half before to this one, by what is not known of the offset; for F'
// = 1.
[[nodiscard]] double unknown_jump_lambda2(const LightBalanceState& state, const BalancedHalf& half,
                                          double signal_per_lambda) noexcept;

// Learn the offset from the jump to this half, before `follow`.
void learn_offset(LightBalanceState& state, const BalancedHalf& half, const DetuningJump& jump,
                  double signal_per_lambda) noexcept;

// Advance by one half-period.
void follow(const MonitorLimits& limits, LightBalanceState& state, const BalancedHalf& half) noexcept;

}  // namespace zlg::core
