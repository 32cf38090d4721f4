#include <zlg/core/compensation/segment_rate.hpp>

#include <zlg/core/common/as_double.hpp>
#include <zlg/core/common/maths.hpp>

namespace zlg::core {

void accumulate(SegmentRateState& state, double angle_arcsec) noexcept {
    const double k = as_double(state.n_ticks) + 0.5;
    double term = angle_arcsec * k;
    for (double& moment : state.moments) {
        term *= k;
        moment += term;
    }
    ++state.n_ticks;
}

SegmentRate rate_of(const SegmentRateState& state, double tick_s) noexcept {
    if (state.n_ticks < 1) return {};
    const auto n = as_double(state.n_ticks);
    // Sums of angle times u^2 .. u^6, over what the weight sums up to, which is n/30, and the tick.
    std::array<double, 5> m = state.moments;
    double power = n;
    for (double& moment : m) {
        power *= n;
        moment *= 30.0 / (n * tick_s) / power;
    }
    // u^2 (1 - u)^2 = u^2 - 2 u^3 + u^4: weighted means of 1, and of x^2 = (2 u - 1)^2.
    const double mean = m[0] - 2.0 * m[1] + m[2];
    const double of_x2 = 4.0 * (m[2] - 2.0 * m[3] + m[4] - (m[1] - 2.0 * m[2] + m[3])) + mean;
    // The projection on x^2 - 1/7, over its weighted mean square.
    return {.mean_arcsec_s = mean, .curvature_arcsec_s = 147.0 / 4.0 * (of_x2 - mean / 7.0)};
}

double mean_rate_variance(const SegmentRateState& state, double tick_s, double walk_arcsec_sqrt_s,
                          double count_arcsec) noexcept {
    if (state.n_ticks < 1) return infinity;
    const auto n = as_double(state.n_ticks);
    const double length_s = n * tick_s;
    const double of_walk = 10.0 / 7.0 * walk_arcsec_sqrt_s * walk_arcsec_sqrt_s / length_s;
    return of_walk + 120.0 / 7.0 / 12.0 * count_arcsec * count_arcsec / (n * length_s * length_s);
}

}  // namespace zlg::core
