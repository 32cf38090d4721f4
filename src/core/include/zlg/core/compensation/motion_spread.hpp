#pragma once
// How far the motion scatters, as the half-periods need it: of settled ticks, each forgotten as what is learnt is.

#include <array>

namespace zlg::core {

struct MotionSpread {
    double n_ticks = 0.0;  // in the means, up to those after which a tick counts 1/e
    double mean_half_arcsec = 0.0;
    double tick_arcsec2 = 0.0;               // variance of a tick about the mean
    double second_difference_arcsec2 = 0.0;  // of three halves in a row
    bool goes_on = false;                    // the tick before was settled:
    std::array<double, 2> last_arcsec{};     // its halves

    friend bool operator==(const MotionSpread&, const MotionSpread&) = default;
};

// Add one tick; its halves, without the bias.
void add(MotionSpread& spread, bool settled, double first_arcsec, double second_arcsec, double forget_ticks) noexcept;

}  // namespace zlg::core
