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
// With `auto` the estimate of the switch (switch_estimate.hpp) takes the place of (15), made once, from all ticks
// around the gap when the last of them is in; `points_after` of (17) is then `ticks_to_correction`.
//
// Only measured ticks take part, with their final values; where some of the standard positions are missing, the fit is
// made with the others, of an order that they allow. At the start of a log eq (14) is used in reversed time.
//
// Where the counter knows the sum over ticks of a gap, their estimates are conditioned on that sum (gap_known.hpp),
// also in a gap that is too long for any other method.
//
// Law: after each correction the delivered and the final values have the same sum, but for gaps whose correction is
// still pending.

#include <span>

#include <zlg/core/compensation/gap_bridge_config.hpp>
#include <zlg/core/compensation/gap_bridge_state.hpp>
#include <zlg/core/records.hpp>

namespace zlg::core {

// Advance by one tick.
//
// return  dtheta of this tick; the final row of the tick `final_delay_ticks` ago, once there is one; the report of a
// gap
//         that was resolved now.
// cost    bounded: where a gap is resolved 16 ticks by 16 points, or one estimate.
[[nodiscard]] AngleSample step(const CompensationConstants& gyro, const GapBridgeConfig& config, GapBridgeState& state,
                               const TickInput& tick) noexcept;

// What the half-periods have asked for, and what can be learnt by now. `step` does it itself, but where the background
// does: there it is to be called between the half-periods, by one caller, whom `step` may interrupt.
//
// bank  members of the estimate: a trial may hand fewer.
void work(const CompensationConstants& gyro, const GapBridgeConfig& config, GapBridgeState& state,
          Pause pause = nullptr, std::span<const BankMember> bank = motion_bank) noexcept;

struct DrainOutput {
    bool has_row = false, has_gap = false;
    AngleRow row{};
    GapReport gap{};
};

// The log has ended: one more report of a gap or final row at each call, until there is neither.
[[nodiscard]] DrainOutput drain(const CompensationConstants& gyro, const GapBridgeConfig& config,
                                GapBridgeState& state) noexcept;

}  // namespace zlg::core
