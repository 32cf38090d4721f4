#pragma once
// A gap and the ticks after it as the estimate of the switch sees them, and their final values by it
// (switch_estimate.hpp).
//
// Rows of the window: half-ticks to eight ticks before and after the gap, ticks after these, in the gap ticks, or a few
// together where it is long; lit halves of the gap are points. What was corrected before in another switch is a tick,
// with its variance.

#include <cstdint>

#include <zlg/core/compensation/gap_bridge_config.hpp>
#include <zlg/core/compensation/gap_bridge_state.hpp>

namespace zlg::core {

struct SwitchAngle {
    bool known = false;             // false: no point on one side, or no estimate
    ExactSum gap_arcsec{};          // final minus delivered, of the gap
    ExactSum after_arcsec{};        // that of the ticks after it that are corrected
    double variance_arcsec2 = 0.0;  // of all these together, but for the ticks behind the window
    std::int64_t behind = 0;        // the first of these
};

// Ask for the estimate of a gap, from the ticks before `end`: where there is a point on both sides, and a place for one
// more.
void ask(const CompensationConstants& gyro, const GapBridgeConfig& config, GapBridgeState& state, PendingGap& pending,
         std::int64_t end) noexcept;

// Take the estimate, if there is one, and give the gap and the ticks after it their final values.
//
// late  it is recorded as not ready, and is not taken.
[[nodiscard]] SwitchAngle take(const CompensationConstants& gyro, GapBridgeState& state, PendingGap& pending,
                               bool late) noexcept;

// Variance of a tick about the mean rate, as learnt; infinite where nothing is.
[[nodiscard]] double tick_variance(const GapBridgeState& state) noexcept;

}  // namespace zlg::core
