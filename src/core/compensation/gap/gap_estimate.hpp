#pragma once
// The optimal estimate of a gap from the ticks around it.

#include <cstdint>

#include <zlg/core/compensation/gap_bridge.hpp>

namespace zlg::core {

// Ticks of a gap that are predicted when it begins; beyond them the mean rate is taken.
inline constexpr int predicted_ticks = 4;

// A gap begins at `tick`: predict it from the ticks before, if the motion is known.
void predict_gap(const GapBridgeConfig& config, GapBridgeState& state, std::int64_t tick) noexcept;

struct EstimatedAngle {
    bool known = false;                        // rows have their final values
    bool has_history = false;                  // false: nothing is known of the motion
    int order = 2;                             // of the polynomial, where that does better
    double sigma_sum_arcsec = 0.0;             // of the whole switch
    double polynomial_variance_arcsec2 = 0.0;  // at least, of the polynomial's angle
    ExactSum gap_arcsec{};                     // final minus delivered in the gap
    ExactSum after_arcsec{};                   // change of the final values after it
};

// Give a gap of at most 16 ticks and the re-lock ticks after it their final values, from the ticks before `end`.
//
// work  that may still be done: points, or stages of the solution; a stage of half-ticks is 2. Not enough, where gaps crowd: the polynomial is left.
[[nodiscard]] EstimatedAngle estimate(const GapBridgeConfig& config, GapBridgeState& state, const Gap& gap,
                                      std::int64_t end, int work) noexcept;

// Learn from one tick.
//
// idle  no gap lasts, waits or was resolved in this tick.
void learn(const GapBridgeConfig& config, GapBridgeState& state, const TickInput& tick, bool idle) noexcept;

// Order of the polynomial that stands in for the estimate.
[[nodiscard]] int order_in_place(const GapBridgeConfig& config, const GapBridgeState& state) noexcept;

}  // namespace zlg::core
