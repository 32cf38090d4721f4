#pragma once
// Eqs (14) and (15): a polynomial through the measured ticks beside a gap.

#include <cstdint>

#include <zlg/core/common/maths.hpp>
#include <zlg/core/compensation/gap_bridge_state.hpp>

namespace zlg::core {

// Through the ticks that were measured, among so many before a gap of n ticks and so many after it that lie before
// `end`. Position 0 is the tick before the gap.
[[nodiscard]] PolynomialFit fit_beside(const GapBridgeState& state, const Gap& gap, int n_before, int n_after,
                                       std::int64_t end, int order) noexcept;

struct PolynomialSum {
    double value_arcsec = 0.0;
    double variance_arcsec2 = 0.0;
};

// Of the points of a fit.
[[nodiscard]] PolynomialSum sum_of(const CompensationConstants& gyro, const GapBridgeState& state, const Gap& gap,
                                   const PolynomialFit& fit, const FitWeights& weight) noexcept;

[[nodiscard]] inline double deviation(double variance) noexcept {
    return variance >= 0.0 ? square_root(variance) : infinity;
}

}  // namespace zlg::core
