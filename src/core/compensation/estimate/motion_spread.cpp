#include <zlg/core/compensation/motion_spread.hpp>

#include "common/bounds.hpp"

namespace zlg::core {

void add(MotionSpread& spread, bool settled, double first_arcsec, double second_arcsec, double forget_ticks) noexcept {
    if (!settled) {
        spread.goes_on = false;
        return;
    }
    if (spread.n_ticks < forget_ticks) spread.n_ticks += 1.0;
    const double part = 1.0 / spread.n_ticks;
    const double off = first_arcsec + second_arcsec - 2.0 * spread.mean_half_arcsec;
    spread.mean_half_arcsec += 0.5 * part * off;
    spread.tick_arcsec2 += part * (square(off) * (1.0 - part) - spread.tick_arcsec2);
    if (spread.goes_on) {
        const auto [p, q] = spread.last_arcsec;
        const double sq = 0.5 * (square(p - 2.0 * q + first_arcsec) + square(q - 2.0 * first_arcsec + second_arcsec));
        spread.second_difference_arcsec2 += part * (sq - spread.second_difference_arcsec2);
    }
    spread.goes_on = true;
    spread.last_arcsec = {first_arcsec, second_arcsec};
}

}  // namespace zlg::core
