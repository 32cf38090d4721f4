#pragma once
// Eq (15): the final values of a gap from the measured ticks on its two sides.

#include <array>
#include <cstdint>

#include <zlg/core/common/maths.hpp>
#include <zlg/core/compensation/gap_bridge.hpp>

namespace zlg::core {

[[nodiscard]] inline HistoryTick& at(GapBridgeState& state, std::int64_t tick) noexcept {
    return state.history[static_cast<std::uint64_t>(tick) % history_ticks];
}

[[nodiscard]] inline const HistoryTick& at(const GapBridgeState& state, std::int64_t tick) noexcept {
    return state.history[static_cast<std::uint64_t>(tick) % history_ticks];
}

// The measured ticks among some standard positions, counted from the tick before a gap.
struct Points {
    int n = 0;
    std::array<std::int32_t, max_fit_points> position{};

    // Positions from..to that lie before tick `end` and were measured.
    void collect(const GapBridgeState& state, std::int64_t origin, int from, int to, std::int64_t end) noexcept;
};

// The covariance of two neighbouring ticks, twice and without its sign: the rounding of one counter reading enters both
// with opposite signs, -count^2/12.
[[nodiscard]] inline double shared_rounding(const GapBridgeConfig& config) noexcept {
    return config.count.value() * config.count.value() / 6.0;
}

[[nodiscard]] inline bool neighbours(const PolynomialFit& fit, int k) noexcept {
    return k > 0 && fit.position(k) == fit.position(k - 1) + 1;
}

[[nodiscard]] inline double deviation(double variance) noexcept {
    return variance >= 0.0 ? square_root(variance) : infinity;
}

// Make `sums`, of `state`, empty ones of a gap of at most 16 ticks, with its fit through the ticks before `end`, of which
// one at least was measured.
void begin_sums(const GapBridgeConfig& config, const GapBridgeState& state, const Gap& gap, std::int64_t end, int order,
                GapSums& sums) noexcept;

// Let the sums of a gap grow to the first `n_points` points of their fit.
void add_points(const GapBridgeConfig& config, const GapBridgeState& state, const Gap& gap, int n_points,
                GapSums& sums) noexcept;

// What `prepare` does, at the end of a tick that did not resolve a gap itself.
void prepare_after(const GapBridgeConfig& config, GapBridgeState& state, bool measured) noexcept;

}  // namespace zlg::core
