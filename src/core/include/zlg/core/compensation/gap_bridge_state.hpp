#pragma once
// All that the gap bridge remembers.

#include <array>
#include <cstdint>

#include <zlg/core/compensation/angle.hpp>
#include <zlg/core/compensation/joint_relock.hpp>
#include <zlg/core/compensation/motion_learning.hpp>
#include <zlg/core/compensation/optimal_bridge.hpp>
#include <zlg/core/compensation/polynomial_fit.hpp>
#include <zlg/core/records.hpp>

namespace zlg::core {

inline constexpr int max_gap_ticks = 16;     // a longer gap is not repaired
inline constexpr int max_points = 8;         // on each side
inline constexpr int max_pending_gaps = 12;  // gaps that wait for the ticks after them
inline constexpr int history_ticks = 64;

struct HistoryTick {
    AngleRow row{};
    double variance_arcsec2 = 0.0;
    double relock_variance_arcsec2 = 0.0;  // of the re-lock correction, a part of the variance
    double half_excess_arcsec = 0.0;       // first half over the second, without the bias
    std::int8_t sign = 1;                  // of the bias in its first half
    bool measured = false;
    std::int64_t known_ticks = 0;  // that end with this one and have a known sum; 0: none
    double known_arcsec = 0.0;

    friend bool operator==(const HistoryTick&, const HistoryTick&) = default;
};

// Where a gap lies.
struct Gap {
    bool has_before = false;  // a measured tick precedes it
    std::int8_t mode_before = 1;
    std::int64_t first_tick = 0, n = 0;       // n: ticks so far
    ExactSum final_minus_delivered_arcsec{};  // of one that is too long: what its ticks lack
    std::int64_t known_ticks = 0;             // whose sums are known
    double known_variance_arcsec2 = 0.0;      // of all these together

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

// The gap that lasts, as far as the covariance of the motion predicts it.
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
    bool solving = false;
    GapProblem problem{};
    std::array<std::int8_t, max_unknowns> index{};  // of those that were added, in order of time with the missing ones
    Column relock_variance_arcsec2{};               // of ticks
    GapData data{};
    GapSolution solution{};

    friend bool operator==(const EstimatedGap&, const EstimatedGap&) = default;
};

struct GapBridgeState {
    std::int64_t next_tick = 0, next_final = 0;
    OpenGap gap{};
    int n_pending = 0;
    std::array<PendingGap, max_pending_gaps> pending{};
    MotionLearningState learning{};
    GapPrediction prediction{};
    EstimatedGap estimate{};
    JointRelock
        joint{};  // of the gap that ended last, put here once it is known or given up, before that gap is resolved
    BiasScale bias_scale{};
    double bias_arcsec = 0.0;  // what a positive bias adds to a half; of half-ticks alone
    ExactSum carry_arcsec{};   // what rounding left of the corrections so far
    std::array<HistoryTick, history_ticks> history{};

    friend bool operator==(const GapBridgeState&, const GapBridgeState&) = default;
};

}  // namespace zlg::core
