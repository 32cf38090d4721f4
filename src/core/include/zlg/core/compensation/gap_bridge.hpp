#pragma once
// Substitution of the ticks of a gap: extrapolated while it lasts, interpolated when its other side is known.
//
// A gap has ticks j = 1..n; j = 0 is the last tick before it, j = n + 1 the first after it.
//
//   eq (14)  in the gap: dtheta_j = least-squares polynomial through the `extrapolation_points` ticks j <= 0
//   eq (15)  final: the same through `points_before` ticks j <= 0 and `points_after` ticks j > n
//   eq (17)  their difference is added in ONE tick, j = n + 1 + points_after, or in the first measured tick after it
//            where that one lies in the next gap
//
// Only measured ticks take part, with their final values; where some of the standard positions are missing, the fit is
// made with the others, of an order that they allow. At the start of a log eq (14) is used in reversed time.
//
// Where the counter has the sum over ticks of a gap, what the motion makes of them is shifted to that sum, see
// gap_known.hpp: also in a gap that is too long for all else.
//
// What is delivered and what is final have the same sum after each correction, unless a later gap still owes its own.

#include <cstdint>

#include <zlg/core/compensation/gap_bridge_state.hpp>
#include <zlg/core/compensation/optimal_bridge.hpp>
#include <zlg/core/methods.hpp>
#include <zlg/core/records.hpp>
#include <zlg/core/units.hpp>

namespace zlg::core {

struct GapBridgeConfig {
    BridgeMethod method = BridgeMethod::quadratic;
    int extrapolation_points = 4;   // 1..8, more than the order
    int points_before = 2;          // 1..8
    int points_after = 2;           // 1..8, with points_before more than the order
    Arcsec count{3.263};            // one count, whose rounding is shared by neighbouring ticks; >= 0
    OptimalBridgeConfig optimal{};  // of `optimal` and `automatic`; its counter_step is this count
};

enum class GapBridgeFault : unsigned char {
    none,
    extrapolation_points,
    points_before,
    points_after,
    order,
    count,
    optimal
};

[[nodiscard]] GapBridgeFault check(const GapBridgeConfig& config) noexcept;

// A gap is bridged by its optimal estimate, where the motion is known.
[[nodiscard]] constexpr bool is_estimated(const GapBridgeConfig& c) noexcept {
    return c.method == BridgeMethod::optimal || c.method == BridgeMethod::automatic;
}

// Ticks that the estimate of half-ticks takes after the last point.
inline constexpr int joint_ticks = 5;

// Measured ticks after a gap before the one that carries its correction.
[[nodiscard]] constexpr int ticks_to_correction(const GapBridgeConfig& c) noexcept {
    if (!is_estimated(c)) return c.points_after;
    return c.optimal.halves ? max_points_a_side + joint_ticks : max_points_a_side;
}

// Ticks between a tick and its final value: nothing about it changes later. At most 29.
[[nodiscard]] constexpr int final_delay_ticks(const GapBridgeConfig& c) noexcept {
    const int wait = ticks_to_correction(c);
    return max_gap_ticks + (c.extrapolation_points > wait ? c.extrapolation_points : wait);
}

// One tick as measured, or the place of one in a gap.
struct TickInput {
    bool measured = true;       // false: a tick of a gap
    double value_arcsec = 0.0;  // with the re-lock correction; in a gap what the counter read
    double variance_arcsec2 = 0.0;
    double relock_arcsec = 0.0;            // the correction in it
    double relock_variance_arcsec2 = 0.0;  // its variance, a part of the whole
    double half_excess_arcsec = 0.0;       // first half over the second, without the bias
    double bias_arcsec = 0.0;              // what a positive bias adds to a half, as far as half-ticks are used
    bool settled = true;                   // re-lock is over: the tick shows the motion alone
    std::int8_t mode = 1;
    std::int8_t sign = 1;  // bias_sign * mode in its first half
    std::uint32_t flags = 0;
    bool amend_previous = false;          // the previous, measured tick becomes final now
    double amend_arcsec = 0.0;            // to be added to its final value
    double amend_variance_arcsec2 = 0.0;  // to be added to its variance
    std::uint32_t amend_flags = 0;
    std::int64_t known_ticks = 0;  // so many ticks of the gap, this one the last, have a known sum; 0: none
    double known_arcsec = 0.0;     // that sum
    double known_variance_arcsec2 = 0.0;
    double known_drift_arcsec2 = 0.0;  // the part of it that the detuning makes
};

// Take one tick.
//
// return  dtheta of this tick; the final row of the tick `final_delay_ticks` ago, once there is one; the report of a gap
//         that was resolved now.
// cost    bounded: where a gap is resolved 16 ticks by 16 points.
[[nodiscard]] AngleSample step(const GapBridgeConfig& config, GapBridgeState& state, const TickInput& tick) noexcept;

// The profile that was told last is that of a gap which is not yet resolved.
[[nodiscard]] bool needs_profile(const GapBridgeState& state) noexcept;

// Go on with the estimate of a gap that waits, from earlier ticks alone: once between two ticks. An estimate of half-ticks that is
// not ready in time leaves its gap to the polynomial.
void advance_estimate(const GapBridgeConfig& config, GapBridgeState& state) noexcept;

struct DrainOutput {
    bool has_row = false, has_gap = false;
    AngleRow row{};
    GapReport gap{};
};

// The log has ended: one more report of a gap or final row at each call, until there is neither.
[[nodiscard]] DrainOutput drain(const GapBridgeConfig& config, GapBridgeState& state) noexcept;

}  // namespace zlg::core
