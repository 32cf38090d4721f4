#include "gap_final.hpp"

#include <zlg/core/common/maths.hpp>

#include "common/bounds.hpp"
#include "gap_interpolation.hpp"
#include "gap_points.hpp"

namespace zlg::core {
namespace {

// The mean square of what the mixture changes, or the variance that it adds, must be more than this part of the variance of
// the learnt motion.
constexpr double negligible = 0.02;

// A manoeuvre is smoother than a random walk in one place and sharper in another, so that a model's own variance is too
// small where it matters: by so much, in parts of it, where something is sure to have happened, and less, as the square,
// where it is not. By trial on zlg_manoeuvre_campaign and, at rest, on zlg_sigma_campaign.
constexpr double added_uncertainty = 3.5;

// Variances beyond which an estimated error of a re-lock may be the motion: three standard deviations, and any where
// something beside the learnt motion was found.
constexpr double sure_error_sq = 9.0;

void apply_to_gap(const GapEstimate& found, AngleRow& row, unsigned j) noexcept {
    row.dtheta_final_arcsec = found.value_arcsec[j];
    row.sigma_arcsec = deviation(found.variance_arcsec2[j]);
    row.flags = (row.flags & ~(std::uint32_t{flag_unrepaired} | flag_lower_order)) | flag_interpolated;
}

}  // namespace

bool finds_something(const GapMixture& mixture) noexcept {
    const MixtureEstimate& m = mixture.estimate;
    const double learnt = mixture.nothing.variance;
    const double changed = m.coarse_off_arcsec2 + m.variance_arcsec2 - (1.0 - m.nothing) * learnt;
    return m.known && m.nothing < most_of_nothing &&
           (size(changed) > negligible * learnt || m.coarse_off_arcsec2 > negligible * learnt);
}

double mixed_variance(const GapBridgeState& state, double variance) noexcept {
    const EstimatedGap& e = state.estimate;
    const MixtureEstimate& m = e.mixture.estimate;
    const GapEstimate& found = e.solution.estimate;
    // The angle of the switch by the learnt motion, less that by the same with whole ticks.
    double off = -e.mixture.nothing.value - product(e.data.error_with_all, found.dual, e.problem.factor.n);
    for (unsigned j = 0; j < static_cast<unsigned>(e.problem.n_gap); ++j) off += found.value_arcsec[j] - e.data.level;
    const double mean = m.nothing * off + m.off_arcsec;
    const double something = against_nothing(m);
    const double added = e.learnt ? added_uncertainty * something * something : 0.0;
    const double of_others = (1.0 + added) * m.variance_arcsec2;
    const double scatter = m.coarse_off_arcsec2 - 2.0 * mean * m.coarse_off_arcsec + (1.0 - m.nothing) * mean * mean;
    return m.nothing * (variance + (off - mean) * (off - mean)) + of_others + scatter;
}

void apply(GapBridgeState& state, const Gap& gap, const GapEstimate& found, double variance,
           EstimatedAngle& out) noexcept {
    for (unsigned j = 0; j < static_cast<unsigned>(gap.n); ++j) {
        AngleRow& row = at(state, gap.first_tick + j).row;
        apply_to_gap(found, row, j);
        out.gap_arcsec.add(row.dtheta_final_arcsec);
        out.gap_arcsec.add(-row.dtheta_arcsec);
    }
    const double sure_sq = finds_something(state.estimate.mixture) ? 0.0 : sure_error_sq;
    if (state.estimate.problem.halves)
        correct_halves(state, found, sure_sq, out.after_arcsec);
    else
        correct_ticks(state, found, sure_sq, out.after_arcsec);
    out.known = true;
    out.sigma_sum_arcsec = deviation(variance);
}

void apply_mixture(GapBridgeState& state, const Gap& gap, double of_learnt, double variance,
                   EstimatedAngle& out) noexcept {
    GapEstimate& found = state.estimate.solution.estimate;
    const MixtureEstimate& m = state.estimate.mixture.estimate;
    const double of_others = variance - m.nothing * of_learnt;
    const double each = of_others > 0.0 ? of_others / static_cast<double>(gap.n) : 0.0;
    for (unsigned j = 0; j < static_cast<unsigned>(gap.n); ++j)
        found.variance_arcsec2[j] = m.nothing * found.variance_arcsec2[j] + each;
    apply(state, gap, found, variance, out);
}

}  // namespace zlg::core
