#pragma once
// Sigma of a gap that a polynomial bridges because nothing has been learnt of the motion yet.
//
// The ticks beside the gap are held against motions of three shapes, slow, smooth and rough, and of many sizes. Each says what
// the angle of the gap would be, and how well it is known; how probable it makes the ticks is its weight. The variance of
// the polynomial is that of the mixture, and what lies between the two. Where the same polynomial can be tried on stretches
// that were measured, its mean square error there has its part as well.

#include <array>
#include <cstdint>

#include <zlg/core/compensation/gap_bridge.hpp>

namespace zlg::core {

struct FewTicks {
    bool known = false;
    double sum_variance_arcsec2 = 0.0;  // of the whole switch
    std::array<double, max_gap_ticks> variance_arcsec2{};
};

// fit           the polynomial, of which at least one point is known.
// value_arcsec  what it gives the ticks of the gap.
// end           no tick from here on is looked at.
[[nodiscard]] FewTicks judge_by_few(const GapBridgeConfig& config, const GapBridgeState& state, const Gap& gap,
                                    std::int64_t end, const PolynomialFit& fit,
                                    const std::array<double, max_gap_ticks>& value_arcsec) noexcept;

}  // namespace zlg::core
