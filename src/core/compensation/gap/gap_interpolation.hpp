#pragma once
// Eq (15): the final values of a gap from the measured ticks on its two sides.

#include <array>
#include <cstdint>

#include <zlg/core/common/maths.hpp>
#include <zlg/core/compensation/gap_bridge_config.hpp>
#include <zlg/core/compensation/gap_bridge_state.hpp>

namespace zlg::core {

// The measured ticks among some standard positions, counted from the tick before a gap.
struct Points {
    int n = 0;
    std::array<std::int32_t, max_fit_points> position{};

    // Positions from..to that lie before tick `end` and were measured.
    void collect(const GapBridgeState& state, std::int64_t origin, int from, int to, std::int64_t end) noexcept;
};

[[nodiscard]] inline bool neighbours(const PolynomialFit& fit, int k) noexcept {
    return k > 0 && fit.position(k) == fit.position(k - 1) + 1;
}

[[nodiscard]] inline double deviation(double variance) noexcept {
    return variance >= 0.0 ? square_root(variance) : infinity;
}

// Eq (15) for each tick of one gap.
struct GapSums {
    PolynomialFit fit{};  // position 0 is the tick before the gap
    std::array<double, max_estimated_gap> value_arcsec{};
    std::array<double, max_estimated_gap> variance_arcsec2{};
    double angle_variance_arcsec2 = 0.0;  // of the whole gap's angle, with the re-lock errors of its points behind it
};

// Of a gap of at most 40 ticks, through the ticks before `end`, of which one at least was measured.
[[nodiscard]] GapSums sums_of(const CompensationConstants& gyro, const GapBridgeConfig& config,
                              const GapBridgeState& state, const Gap& gap, std::int64_t end, int order) noexcept;

}  // namespace zlg::core
