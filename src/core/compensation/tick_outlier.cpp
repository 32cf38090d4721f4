#include <zlg/core/compensation/tick_outlier.hpp>

namespace zlg::core {
namespace {

constexpr std::int32_t remembered_ticks = 128;
constexpr double square_of_rounding = 3.0;
constexpr double most_of_rounding = 27.0 / 2.0;
// Four standard deviations of a random motion; the peak of a sine is the root of two.
constexpr double most_of_roughness = 16.0;
constexpr double in_doubt = 0.25;

}  // namespace

double step(TickOutlierState& state, double apart_arcsec, double variance_arcsec2, bool learns) noexcept {
    const double sq = apart_arcsec * apart_arcsec;
    const double rough = state.roughness_arcsec2 > 0.0 ? state.roughness_arcsec2 : 0.0;
    const double limit = most_of_rounding * variance_arcsec2 + most_of_roughness * rough;
    const bool is_apart = sq > limit;
    if (learns) {
        if (state.n < remembered_ticks) ++state.n;
        const double excess = (is_apart ? limit : sq) - square_of_rounding * variance_arcsec2;
        state.roughness_arcsec2 += (excess - state.roughness_arcsec2) / static_cast<double>(state.n);
    }
    return is_apart ? in_doubt * sq : 0.0;
}

}  // namespace zlg::core
