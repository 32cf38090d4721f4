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
// The sum of what is delivered and the sum of the final values are the same after each correction, unless a later gap
// still owes its own.

#include <array>
#include <cstdint>

#include <zlg/core/angle.hpp>
#include <zlg/core/methods.hpp>
#include <zlg/core/polynomial_fit.hpp>
#include <zlg/core/records.hpp>
#include <zlg/core/units.hpp>

namespace zlg::core {

inline constexpr int max_gap_ticks = 16;    // a longer gap is not repaired
inline constexpr int max_points = 8;        // on each side
inline constexpr int max_pending_gaps = 8;  // gaps that wait for the ticks after them
inline constexpr int history_ticks = 64;

struct GapBridgeConfig {
    BridgeMethod method = BridgeMethod::quadratic;
    int extrapolation_points = 4;  // 1..8, more than the order
    int points_before = 2;         // 1..8
    int points_after = 2;          // 1..8, with points_before more than the order
    Arcsec count{3.263};           // one count, whose rounding is shared by neighbouring ticks; >= 0
};

enum class GapBridgeFault : unsigned char { none, extrapolation_points, points_before, points_after, order, count };

[[nodiscard]] GapBridgeFault check(const GapBridgeConfig& config) noexcept;

// The polynomial order of a method; 0 for `none`.
[[nodiscard]] int order_of(BridgeMethod method) noexcept;

// Ticks between a tick and its final value: nothing about it changes later. At most 24.
[[nodiscard]] int final_delay_ticks(const GapBridgeConfig& config) noexcept;

// One tick as measured, or the place of one in a gap.
struct TickInput {
    bool measured = true;       // false: a tick of a gap
    double value_arcsec = 0.0;  // with the re-lock correction; in a gap what the counter read
    double variance_arcsec2 = 0.0;
    double relock_arcsec = 0.0;  // the correction in it
    std::int8_t mode = 1;
    std::int8_t sign = 1;  // bias_sign * mode in its first half
    std::uint32_t flags = 0;
    bool amend_previous = false;          // the previous, measured tick becomes final now
    double amend_arcsec = 0.0;            // to be added to its final value
    double amend_variance_arcsec2 = 0.0;  // to be added to its variance
    std::uint32_t amend_flags = 0;
};

struct HistoryTick {
    AngleRow row{};
    double variance_arcsec2 = 0.0;
    bool measured = false;

    friend bool operator==(const HistoryTick&, const HistoryTick&) = default;
};

// The gap that lasts.
struct OpenGap {
    bool open = false;
    bool has_before = false;   // a measured tick precedes it
    bool lower_order = false;  // of the extrapolation
    std::int8_t mode_before = 1;
    std::int64_t first_tick = 0;
    std::int64_t n = 0;   // ticks so far
    PolynomialFit fit{};  // eq (14)
    std::array<double, max_points> value_arcsec{};
    // Of a gap that is too long: the mean of the extrapolation points, and how far its ticks are above the delivered.
    double constant_arcsec = 0.0;
    ExactSum final_minus_delivered_arcsec{};

    friend bool operator==(const OpenGap&, const OpenGap&) = default;
};

// A gap that is over and waits for the ticks after it, and then for a tick to carry its correction.
struct PendingGap {
    OpenGap gap{};
    std::int64_t due_tick = 0;
    std::int8_t sign_after = 1;
    std::int8_t mode_after = 1;
    bool resolved = false;
    ExactSum lump_arcsec{};  // final minus delivered, of all that this gap made uncertain

    friend bool operator==(const PendingGap&, const PendingGap&) = default;
};

struct GapBridgeState {
    std::int64_t next_tick = 0;
    std::int64_t next_final = 0;
    OpenGap gap{};
    int n_pending = 0;
    std::array<PendingGap, max_pending_gaps> pending{};
    ExactSum carry_arcsec{};  // what rounding left of the corrections so far
    std::array<HistoryTick, history_ticks> history{};

    friend bool operator==(const GapBridgeState&, const GapBridgeState&) = default;
};

// Take one tick.
//
// return   dtheta of this tick; the final row of the tick `final_delay_ticks` ago, once there is one; the report of a
//          gap that was resolved now.
// cost     bounded: where a gap is resolved the weights of at most 16 ticks by 16 points, in a gap those of one tick.
[[nodiscard]] AngleSample step(const GapBridgeConfig& config, GapBridgeState& state, const TickInput& tick) noexcept;

struct DrainOutput {
    bool has_row = false;
    AngleRow row{};
    bool has_gap = false;
    GapReport gap{};
};

// The log has ended: one more report of a gap or final row at each call, until there is neither.
[[nodiscard]] DrainOutput drain(const GapBridgeConfig& config, GapBridgeState& state) noexcept;

}  // namespace zlg::core
