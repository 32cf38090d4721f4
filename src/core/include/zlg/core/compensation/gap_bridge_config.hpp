#pragma once
// What the gap bridge is asked to do, and what follows for the time that it takes.

#include <zlg/core/compensation/compensation_constants.hpp>
#include <zlg/core/compensation/gap_bridge_state.hpp>
#include <zlg/core/compensation/optimal_bridge.hpp>
#include <zlg/core/methods.hpp>
#include <zlg/core/units.hpp>

namespace zlg::core {

struct GapBridgeConfig {
    BridgeMethod method = BridgeMethod::quadratic;
    int extrapolation_points = 4;   // 1..8, more than the order
    int points_before = 2;          // 1..8
    int points_after = 2;           // 1..8, with points_before more than the order
    OptimalBridgeConfig optimal{};  // of `optimal` and `automatic`
};

enum class GapBridgeFault : unsigned char { none, extrapolation_points, points_before, points_after, order, optimal };

[[nodiscard]] GapBridgeFault check(const GapBridgeConfig& config) noexcept;

// A gap is bridged by its optimal estimate, where the motion is known.
[[nodiscard]] constexpr bool is_estimated(const GapBridgeConfig& c) noexcept {
    return c.method == BridgeMethod::optimal || c.method == BridgeMethod::automatic;
}

// Ticks that the computation of an estimate lasts after the last point.
inline constexpr int estimate_ticks = 5;

// Ticks from the first one after a gap to the one that carries its correction.
[[nodiscard]] constexpr int ticks_to_correction(const GapBridgeConfig& c) noexcept {
    return is_estimated(c) ? max_points_a_side + estimate_ticks : c.points_after;
}

// Ticks between a tick and its final value: nothing about it changes later. At most 29.
[[nodiscard]] constexpr int final_delay_ticks(const GapBridgeConfig& c) noexcept {
    const int wait = ticks_to_correction(c);
    return max_gap_ticks + (c.extrapolation_points > wait ? c.extrapolation_points : wait);
}

}  // namespace zlg::core
