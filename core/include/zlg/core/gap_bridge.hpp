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
// What is delivered and what is final have the same sum after each correction, unless a later gap still owes its own.

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

// Ticks between a tick and its final value: nothing about it changes later. At most 24.
[[nodiscard]] constexpr int final_delay_ticks(const GapBridgeConfig& c) noexcept {
    return max_gap_ticks + (c.extrapolation_points > c.points_after ? c.extrapolation_points : c.points_after);
}

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

// Where a gap lies.
struct Gap {
    bool has_before = false;  // a measured tick precedes it
    std::int8_t mode_before = 1;
    std::int64_t first_tick = 0, n = 0;       // n: ticks so far
    ExactSum final_minus_delivered_arcsec{};  // of one that is too long: what its first 16 ticks lack

    friend bool operator==(const Gap&, const Gap&) = default;
};

// The gap that lasts, and its extrapolation.
struct OpenGap {
    bool open = false, lower_order = false;
    Gap gap{};
    PolynomialFit fit{};  // eq (14)
    std::array<double, max_points> value_arcsec{};
    std::array<double, max_points> variance_arcsec2{};
    double constant_arcsec = 0.0;  // mean of the extrapolation points: all that a gap that is too long gets

    friend bool operator==(const OpenGap&, const OpenGap&) = default;
};

// A gap that is over and waits for the ticks after it, and then for a tick to carry its correction.
struct PendingGap {
    Gap gap{};
    std::int64_t due_tick = 0;
    std::int8_t sign_after = 1, mode_after = 1;
    bool resolved = false;
    ExactSum lump_arcsec{};  // final minus delivered, of all that this gap made uncertain

    friend bool operator==(const PendingGap&, const PendingGap&) = default;
};

// The sums of eq (15) for each tick of one gap; they grow point by point.
struct GapSums {
    std::int64_t first_tick = -1;  // of the gap; -1: of none yet
    PolynomialFit fit{};           // position 0 is the tick before the gap
    int n_added = 0;               // points of the fit that are in the sums
    std::array<double, max_gap_ticks> value_arcsec{};
    std::array<double, max_gap_ticks> variance_arcsec2{};
    std::array<double, max_gap_ticks> last_weight{};               // of the point that was added last
    double angle_variance_arcsec2 = 0.0, last_angle_weight = 0.0;  // the same of the whole gap's angle

    friend bool operator==(const GapSums& a, const GapSums& b) noexcept;
};

struct GapBridgeState {
    std::int64_t next_tick = 0, next_final = 0;
    OpenGap gap{};
    int n_pending = 0;
    std::array<PendingGap, max_pending_gaps> pending{};
    std::array<GapSums, 2> sums{};  // of gaps that were resolved last, or are in the next tick: no more than two
    ExactSum carry_arcsec{};        // what rounding left of the corrections so far
    std::array<HistoryTick, history_ticks> history{};

    friend bool operator==(const GapBridgeState&, const GapBridgeState&) = default;
};

// Take one tick.
//
// return  dtheta of this tick; the final row of the tick `final_delay_ticks` ago, once there is one; the report of a gap
//         that was resolved now.
// cost    bounded: where a gap is resolved 16 ticks by 16 points, or by what `prepare` has left of them.
[[nodiscard]] AngleSample step(const GapBridgeConfig& config, GapBridgeState& state, const TickInput& tick) noexcept;

// Do some of the next tick's work that depends on earlier ticks alone. To be called once between two ticks, or not: no
// output depends on it.
void prepare(const GapBridgeConfig& config, GapBridgeState& state) noexcept;

struct DrainOutput {
    bool has_row = false, has_gap = false;
    AngleRow row{};
    GapReport gap{};
};

// The log has ended: one more report of a gap or final row at each call, until there is neither.
[[nodiscard]] DrainOutput drain(const GapBridgeConfig& config, GapBridgeState& state) noexcept;

}  // namespace zlg::core
