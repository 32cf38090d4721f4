#pragma once
// What the gap bridge is asked to do, and what follows for the time that it takes.

#include <cstdint>

#include <zlg/core/compensation/compensation_constants.hpp>
#include <zlg/core/compensation/switch_window.hpp>
#include <zlg/core/methods.hpp>
#include <zlg/core/units.hpp>

namespace zlg::core {

inline constexpr int max_polynomial_gap = 16;  // of a gap that a polynomial repairs, in ticks
inline constexpr int max_estimated_gap = 40;   // and of one that is estimated

// Ticks beside a gap that the estimate of its switch looks at.
inline constexpr int ticks_before_estimate = 8;
inline constexpr int most_ticks_after_estimate = 20;

inline constexpr int most_relock_ticks = 64;

struct GapBridgeConfig {
    BridgeMethod method = BridgeMethod::quadratic;
    int extrapolation_points = 4;  // 1..8, more than the order
    int points_before = 2;         // 1..8
    int points_after = 2;          // 1..8, with points_before more than the order
    int gap_ticks = 16;            // that a switch is to last, 1..40
    // Of `automatic`: how ticks after a gap are corrected, and how many, 0..64.
    RelockMethod relock = RelockMethod::none;
    std::int64_t relock_ticks = 0;
};

// A gap is bridged by the estimate of its switch.
[[nodiscard]] constexpr bool is_estimated(const GapBridgeConfig& c) noexcept {
    return c.method == BridgeMethod::automatic;
}

[[nodiscard]] constexpr bool is_allowed(const GapBridgeConfig& c) noexcept {
    for (const int points : {c.extrapolation_points, c.points_before, c.points_after})
        if (points < 1 || points > 8) return false;
    const int order = order_of(c.method);
    if (c.extrapolation_points <= order || c.points_before + c.points_after <= order) return false;
    return !is_estimated(c) || (c.gap_ticks >= 1 && c.gap_ticks <= max_estimated_gap && c.relock_ticks >= 0 &&
                                c.relock_ticks <= most_relock_ticks);
}

// The longest gap that is repaired, in ticks.
[[nodiscard]] constexpr int max_gap_ticks(const GapBridgeConfig& c) noexcept {
    return is_estimated(c) && c.gap_ticks > max_polynomial_gap ? c.gap_ticks : max_polynomial_gap;
}

// Ticks from the first one after a gap to the one before which all is known that its final values are made of.
[[nodiscard]] constexpr int ticks_to_last_point(const GapBridgeConfig& c) noexcept {
    if (!is_estimated(c)) return c.points_after;
    const int corrected = c.relock == RelockMethod::none ? 0 : static_cast<int>(c.relock_ticks);
    return corrected > ticks_before_estimate ? corrected : ticks_before_estimate;
}

// What an estimate may last after the last point.
inline constexpr double estimate_s = 0.08;

// Ticks from the first one after a gap to the one that carries its correction.
[[nodiscard]] constexpr int ticks_to_correction(const CompensationConstants& gyro, const GapBridgeConfig& c) noexcept {
    if (!is_estimated(c)) return c.points_after;
    const double ticks = estimate_s / gyro.tick.value();
    const int whole = ticks < 1e6 ? static_cast<int>(ticks) : 1000000;
    // A rounding of the quotient is no tick.
    return ticks_to_last_point(c) + whole + (ticks - whole > 1e-9 ? 1 : 0);
}

// The largest delay of a final value.
inline constexpr int most_final_delay_ticks = 128;

// Ticks between a tick and its final value: nothing about it changes later. At most most_final_delay_ticks.
[[nodiscard]] constexpr int final_delay_ticks(const CompensationConstants& gyro, const GapBridgeConfig& c) noexcept {
    const int wait = ticks_to_correction(gyro, c);
    if (is_estimated(c)) return max_gap_ticks(c) + wait + 1;
    return max_polynomial_gap + (c.extrapolation_points > wait ? c.extrapolation_points : wait);
}

// Half-ticks of the longest window of an estimate; where they are more than the moments hold it goes by whole ticks.
[[nodiscard]] constexpr int window_halves(const GapBridgeConfig& c) noexcept {
    const int after = ticks_to_last_point(c);
    return 2 * (ticks_before_estimate + max_gap_ticks(c) +
                (after < most_ticks_after_estimate ? after : most_ticks_after_estimate));
}

[[nodiscard]] constexpr int window_step_halves(const GapBridgeConfig& c) noexcept {
    return window_halves(c) > most_moment_steps ? 2 : 1;
}

}  // namespace zlg::core
