#pragma once
// State of the gap bridge.

#include <array>
#include <cstdint>

#include <zlg/core/compensation/angle.hpp>
#include <zlg/core/compensation/gap_bridge_config.hpp>
#include <zlg/core/compensation/gap_tick.hpp>
#include <zlg/core/compensation/learnt_motion.hpp>
#include <zlg/core/compensation/polynomial_fit.hpp>
#include <zlg/core/compensation/switch_job.hpp>
#include <zlg/core/compensation/switch_light.hpp>
#include <zlg/core/records.hpp>

namespace zlg::core {

// Gaps that wait for the ticks after them, each of one tick and one more.
inline constexpr int max_pending_gaps = (most_final_delay_ticks - max_polynomial_gap) / 2 + 1;
// A row leaves it when the next tick takes its place; the longest window is shorter.
inline constexpr int history_ticks = most_final_delay_ticks;
static_assert(ticks_before_estimate + max_estimated_gap + most_relock_ticks < history_ticks);

inline constexpr int max_extrapolation_points = 8;

// Age at which what is learnt of the motion counts 1/e, in ticks: a quarter of a minute of 5 ms.
inline constexpr double forget_ticks = 3000.0;

// Where a gap lies.
struct Gap {
    bool has_before = false;  // a measured tick precedes it
    std::int8_t mode_before = 1;
    bool moves = false;                       // the loop is open in it, and the perimeter moves
    double variance_arcsec2 = -1.0;           // of its angle, if it is estimated and nothing else with it
    std::int64_t first_tick = 0, n = 0;       // n: ticks so far
    ExactSum final_minus_delivered_arcsec{};  // of a gap that is too long
    std::int64_t known_ticks = 0;             // whose sums are known
    double known_variance_arcsec2 = 0.0;      // of all these together

    friend bool operator==(const Gap&, const Gap&) = default;
};

// The present gap, and its extrapolation.
struct OpenGap {
    bool open = false, lower_order = false;
    Gap gap{};
    PolynomialFit fit{};  // eq (14)
    std::array<double, max_extrapolation_points> value_arcsec{};
    std::array<double, max_extrapolation_points> variance_arcsec2{};
    double constant_arcsec = 0.0;  // mean of the extrapolation points: all that a gap that is too long gets

    friend bool operator==(const OpenGap&, const OpenGap&) = default;
};

// A gap that is over and waits for the ticks after it, and then for the tick in which its correction is due.
struct PendingGap {
    Gap gap{};
    std::int64_t due_tick = 0;
    std::int16_t ready_before = 0;  // ticks; before that tick its last point lies
    std::int8_t sign_after = 1, mode_after = 1;
    bool asked = false;
    bool is_reported = false;
    ExactSum correction_arcsec{};  // pending: final minus delivered, of the gap and of the ticks that it amended

    friend bool operator==(const PendingGap&, const PendingGap&) = default;
};

struct GapBridgeState {
    std::int64_t next_tick = 0, next_final = 0;
    OpenGap gap{};
    int n_pending = 0;
    // Magnetic drift in a tick of mode +1 that is still in the values, as far as it is known. The points of a gap lose
    // it, for at the gap it steps: an estimate across it would take the step for a false angle or for motion.
    double magnetic_arcsec = 0.0;
    double magnetic_variance_arcsec2 = 0.0;
    double common_arcsec2 = 0.0;          // of the last measured tick, as in TickInput
    bool with_phase = false;              // the readings have the place within the count (note_phase)
    ExactSum rounding_residual_arcsec{};  // sum of the rounding errors of the corrections so far
    MotionSpread spread{};
    SwitchLight light{};
    RelockScale scale{};
    BackgroundWork background{};
    std::array<PendingGap, max_pending_gaps> pending{};
    std::array<HistoryTick, history_ticks> history{};

    friend bool operator==(const GapBridgeState&, const GapBridgeState&) = default;
};

// Of a state, or of one that is only read.
[[nodiscard]] auto& at(auto& state, std::int64_t tick) noexcept {
    return state.history[static_cast<std::size_t>(tick % history_ticks)];
}

}  // namespace zlg::core
