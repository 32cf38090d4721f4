#pragma once
// State of the gap bridge.

#include <array>
#include <cstdint>

#include <zlg/core/compensation/angle.hpp>
#include <zlg/core/compensation/gap_mixture.hpp>
#include <zlg/core/compensation/gap_tick.hpp>
#include <zlg/core/compensation/joint_relock.hpp>
#include <zlg/core/compensation/lit_halves.hpp>
#include <zlg/core/compensation/motion_learning.hpp>
#include <zlg/core/compensation/optimal_bridge.hpp>
#include <zlg/core/compensation/polynomial_fit.hpp>
#include <zlg/core/compensation/tick_outlier.hpp>
#include <zlg/core/records.hpp>

namespace zlg::core {

inline constexpr int max_gap_ticks = 16;     // a longer gap is not repaired
inline constexpr int max_points = 8;         // on each side
inline constexpr int max_pending_gaps = 12;  // gaps that wait for the ticks after them
inline constexpr int history_ticks = 64;

// Where a gap lies.
struct Gap {
    bool has_before = false;  // a measured tick precedes it
    std::int8_t mode_before = 1;
    std::int64_t first_tick = 0, n = 0;       // n: ticks so far
    std::int64_t settled_tick = 0;            // as in TickInput
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
    std::array<double, max_points> value_arcsec{};
    std::array<double, max_points> variance_arcsec2{};
    double constant_arcsec = 0.0;  // mean of the extrapolation points: all that a gap that is too long gets

    friend bool operator==(const OpenGap&, const OpenGap&) = default;
};

// A gap that is over and waits for the ticks after it, and then for the tick in which its correction is due.
struct PendingGap {
    Gap gap{};
    std::int64_t due_tick = 0;
    std::int8_t sign_after = 1, mode_after = 1;
    bool resolved = false;
    double unread_arcsec2 = 0.0;   // variance of what its halves without a point may turn by, as its lit halves show
    ExactSum correction_arcsec{};  // pending: final minus delivered, of the gap and of the ticks that it amended

    friend bool operator==(const PendingGap&, const PendingGap&) = default;
};

// The present gap, as the covariance of the motion predicts it.
struct GapPrediction {
    std::int64_t first_tick = -1;  // of the gap; -1: of none
    std::array<double, max_gap_ticks> value_arcsec{};
    std::array<double, max_gap_ticks> variance_arcsec2{};

    friend bool operator==(const GapPrediction&, const GapPrediction&) = default;
};

// chi f0 as the switches show it, over what the configuration says, less 1.
struct BiasScale {
    double value = 0.0;
    double variance = 1e-4;

    friend bool operator==(const BiasScale&, const BiasScale&) = default;
};

// The gap whose problem grows.
struct EstimatedGap {
    std::int64_t first_tick = -1;  // -1: of none
    std::int64_t end_tick = 0;     // the first one after it
    int n_tried = 0;               // points that were added, or found not to be measured
    bool learnt = true;            // the motion was known when the problem began
    double magnetic_arcsec = 0.0;  // as in GapBridgeState when it began
    double magnetic_variance_arcsec2 = 0.0;
    int n_after = 0;  // ticks after the gap that may be points; before it: problem.n_side
    bool solving = false;
    GapProblem problem{};
    LitHalvesState lit{};                           // of the gap; points of half-ticks, too
    std::array<std::int8_t, max_unknowns> index{};  // of those that were added, in order of time with the missing ones
    Column relock_variance_arcsec2{};               // of ticks
    GapData data{};
    GapSolution solution{};
    bool mixing = false;  // the mixture has its points
    GapMixture mixture{};

    friend bool operator==(const EstimatedGap&, const EstimatedGap&) = default;
};

struct GapBridgeState {
    std::int64_t next_tick = 0, next_final = 0;
    OpenGap gap{};
    int n_pending = 0;
    // Magnetic drift in a tick of mode +1 that is still in the values, as far as it is known. The points of a gap lose it, for at
    // the gap it steps: an estimate across it would take the step for a false angle or for motion.
    double magnetic_arcsec = 0.0;
    double magnetic_variance_arcsec2 = 0.0;
    double relock_to_come_arcsec2 = 0.0;  // variance of the re-lock corrections still to come
    double walk_of_switch_arcsec2 = 0.0;  // as in TickInput
    double common_arcsec2 = 0.0;          // of the last measured tick, as in TickInput
    std::int64_t relock_ticks = 0;        // after a gap, that belong to its switch
    double bias_arcsec = 0.0;             // what a positive bias adds to a half; of half-ticks alone
    ExactSum rounding_residual_arcsec{};  // sum of the rounding errors of the corrections so far
    TickOutlierState outlier{};
    MotionLearningState learning{};
    std::array<PendingGap, max_pending_gaps> pending{};
    GapPrediction prediction{};
    EstimatedGap estimate{};
    // Of the gap that ended last: put here once it is known or given up, before that gap is resolved.
    JointRelock joint{};
    LitHalvesState lit{};  // of the gap that lasts or ended last
    BiasScale bias_scale{};
    std::array<HistoryTick, history_ticks> history{};

    friend bool operator==(const GapBridgeState&, const GapBridgeState&) = default;
};

[[nodiscard]] inline HistoryTick& at(GapBridgeState& state, std::int64_t tick) noexcept {
    return state.history[static_cast<std::uint64_t>(tick) % history_ticks];
}

[[nodiscard]] inline const HistoryTick& at(const GapBridgeState& state, std::int64_t tick) noexcept {
    return state.history[static_cast<std::uint64_t>(tick) % history_ticks];
}

// The profile of the detuning that was delivered last is that of the gap.
[[nodiscard]] bool is_profile_of(const GapBridgeState& state, const Gap& gap) noexcept;

// The profile that was delivered last belongs to a gap that is not yet resolved, so another one must not replace it.
[[nodiscard]] bool needs_profile(const GapBridgeState& state) noexcept;

}  // namespace zlg::core
