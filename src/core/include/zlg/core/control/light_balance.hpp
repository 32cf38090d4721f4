#pragma once
// Balance of the two photodiodes: the constant inequality of the beams is learnt and taken off before anything is judged.
//
// The light signal S = (A - B)/(A + B) is the detuning, whose sign turns with the bias, and what the photodiodes are unequal
// by, which does not turn. With w (B - o) in place of B, for the two halves of a tick and the means a and b of the beams,
//
//   (S_1 + S_2)/2 = (a - w (b - o))/(a + w (b - o))                                                (1)
//
// and w is led to where this is 0, as a mean over `memory_ticks`, by the ticks in which the detuning stands.
//
// An offset is a part of the light that does not fall with it: far from the centre, where the light P = A + w (B - o) is less
// than its level P_0, it is seen as a jump of the detuning where the bias is reversed. An offset of w P_0/2 makes the jump
//
//   h = F'/K sum of (1 + S)/2 (P_0/P - 1 + S)     over both halves beside the reversal             (2)
//
// by which o, of which only the difference of both beams matters, is learnt in every re-lock: Kalman's filter of one state.
//
// A slower mean of w follows it. A weight, learnt over `memory_ticks` at least, that has left it by `max_change` has drifted
// by that within `slow_ticks`: a fault of a photodiode or of a beam, although the detuning is still read.

#include <cstdint>
#include <span>

#include <zlg/core/control/light_monitor.hpp>
#include <zlg/core/records.hpp>

namespace zlg::core {

struct LightBalanceConfig {
    double memory_ticks = 400.0;  // 1..2^30; 2 s of 5 ms: a hundredth of the noise of one half
    double slow_ticks = 48000.0;  // 1..2^30
    double max_change = 0.0133;   // relative; 4 minutes of .2 an hour
};

enum class LightBalanceFault : unsigned char { none, memory_ticks, slow_ticks, max_change };

[[nodiscard]] constexpr LightBalanceFault check(const LightBalanceConfig& c) noexcept {
    constexpr double most_ticks = 1 << 30;
    if (!(c.memory_ticks >= 1.0 && c.memory_ticks <= most_ticks)) return LightBalanceFault::memory_ticks;
    if (!(c.slow_ticks >= 1.0 && c.slow_ticks <= most_ticks)) return LightBalanceFault::slow_ticks;
    return c.max_change > 0.0 && c.max_change <= 1.0 ? LightBalanceFault::none : LightBalanceFault::max_change;
}

struct LightBalanceState {
    double weight = 1.0;                // of beam B
    double slow_weight = 1.0;           // its mean
    double level = 0.0;                 // P_0
    double offset = 0.0;                // of beam B, in the unit of the samples
    double variance = 1e-7;             // of that, in units of P_0/2
    double jumps = 0.0, weights = 0.0;  // sums of h J/r and h^2/r, J: recent jumps, r: their variances
    double n_ticks = 0.0;               // that were learnt from, up to `slow_ticks`
    bool has_last = false;              // the half before was read:
    double last_signal = 0.0;           // its S
    double former_signal = 1.0;         // and that of the one before
    double last_form = 0.0;             // and its part of the sum of (2)

    friend constexpr bool operator==(const LightBalanceState&, const LightBalanceState&) = default;
};

// Beam B of a half, by its weight.
//
// room    receives the samples, as many as there are.
// return  them.
[[nodiscard]] std::span<const float> balanced(const LightBalanceState& state, std::span<const float> beam_b,
                                              std::span<float, max_light_samples> room) noexcept;

struct LightBalanceInput {
    bool is_first = false;             // half of its tick
    bool is_read = false;              // it was closed, lit both ways, and followed the half before
    double signal = 0.0;               // S of the balanced light, its mean over the half
    double light = 0.0;                // P, its mean
    double signal_per_lambda = 0.332;  // K
    DetuningJump jump{};               // from the half before to this one
};

// Variance of the jump of the detuning from the half before to this one, by what is not known of the offset; for F' = 1.
[[nodiscard]] double unknown_jump_lambda2(const LightBalanceState& state, const LightBalanceInput& input) noexcept;

// Learn from one half-period.
//
// return  whether the balance has changed.
bool learn(const LightBalanceConfig& config, LightBalanceState& state, const LightBalanceInput& input) noexcept;

}  // namespace zlg::core
