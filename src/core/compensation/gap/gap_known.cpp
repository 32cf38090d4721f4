#include "gap_known.hpp"

#include <zlg/core/common/as_double.hpp>
#include <zlg/core/common/maths.hpp>
#include <zlg/core/compensation/border.hpp>

#include "common/bounds.hpp"
#include "gap_interpolation.hpp"
#include "gap_switch.hpp"

namespace zlg::core {
namespace {

// A stretch of known sum, and its rows that are not delivered yet: `n` of them, from `first` on.
struct KnownStretch {
    std::int64_t first = 0, last = 0;
    std::int64_t n_delivered = 0;
    double sum_arcsec = 0.0;
    double variance_arcsec2 = 0.0;  // of a single tick

    [[nodiscard]] double n() const noexcept { return as_double(last - first + 1); }
};

double deficit_of(const GapBridgeState& state, const KnownStretch& s, double constant_arcsec) noexcept {
    ExactSum deficit;
    deficit.add(s.sum_arcsec);
    deficit.add(-as_double(s.n_delivered) * constant_arcsec);
    for (std::int64_t t = s.first; t <= s.last; ++t) deficit.add(-at(state, t).row.dtheta_final_arcsec);
    return deficit.value();
}

void set_row(AngleRow& row, double value_arcsec, double variance_arcsec2, ExactSum& change) noexcept {
    change.add_difference(value_arcsec, row.dtheta_final_arcsec);
    row.dtheta_final_arcsec = value_arcsec;
    row.sigma_arcsec = deviation(variance_arcsec2);
    if (!is_finite(row.sigma_arcsec)) return;
    row.flags = (row.flags & ~std::uint32_t{flag_unrepaired}) | flag_interpolated;
}

void count_in(double rounding_arcsec2, std::int64_t n_ticks, double variance_arcsec2, Gap& gap) noexcept {
    // Of the reading between two stretches the one has more what the other has less.
    if (gap.known_ticks > 0)
        gap.known_variance_arcsec2 -= shared_rounding(rounding_arcsec2, gap.known_variance_arcsec2, variance_arcsec2);
    gap.known_ticks += n_ticks;
    gap.known_variance_arcsec2 += variance_arcsec2;
}

// The rows of a stretch get their sum, in (1) with w_j
//
// of a whole gap that is estimated: the regression of tick j on the sum, which takes what the sum tells off its
// variance; what the sum is off by more than three standard deviations may be a rotation in any one of n ticks, each as
// likely:
//
//   r^2 ((1 - w_j)^2 + (n - 1) w_j^2)/n
//
// of another: without learnt motion, a parabola over a whole gap, constant over a part of one. Where the mean rate is
// an outlier, (2) for a rotation in any one tick is added.
void settle(GapBridgeState& state, const Gap& gap, const KnownStretch& s, double constant_arcsec,
            ExactSum& change) noexcept {
    if (s.first > s.last) return;
    if (s.first == s.last && s.n_delivered == 0)
        return set_row(at(state, s.last).row, s.sum_arcsec, s.variance_arcsec2, change);
    const bool is_whole = s.n_delivered == 0 && s.last + 1 - s.first == gap.n;
    const bool is_estimate = is_whole && gap.variance_arcsec2 >= 0.0;
    const double deficit = deficit_of(state, s, constant_arcsec);
    const bool is_outlier = square(deficit) > outlier_sq * (gap.variance_arcsec2 + gap.known_variance_arcsec2);
    const double n = s.n(), n_all = n + as_double(s.n_delivered), mean = s.sum_arcsec / n_all;
    const double of_tick = tick_variance(state), off_level_sq = square(mean - 2.0 * state.spread.mean_half_arcsec);
    const double about_mean = of_tick + (off_level_sq > outlier_sq * of_tick ? off_level_sq * (n_all - 1.0) : 0.0);
    // Per row: the residual of the delivered rows is in the remaining ones.
    const double beyond = as_double(s.n_delivered) * (mean - constant_arcsec) / n;
    for (std::int64_t t = s.first; t <= s.last; ++t) {
        HistoryTick& entry = at(state, t);
        const double before = square(entry.row.sigma_arcsec), j = as_double(t - s.first + 1);
        double w = entry.share, variance = 0.0;
        if (is_estimate) {
            const double left = before - w * w * gap.variance_arcsec2;
            const double outlier = is_outlier ? square(deficit) * (square(1.0 - w) + (n - 1.0) * w * w) / n : 0.0;
            variance = (left > 0.0 ? left : 0.0) + w * w * gap.known_variance_arcsec2 + outlier;
        } else {
            w = is_whole ? 6.0 * j * (n + 1.0 - j) / (n * (n + 1.0) * (n + 2.0)) : 1.0 / n;
            variance = (before < about_mean ? before : about_mean) + beyond * beyond;
            if (before < infinity) variance += deficit * deficit * w * (1.0 - w);
        }
        set_row(entry.row, entry.row.dtheta_final_arcsec + w * deficit, variance, change);
    }
}

}  // namespace

void note_known(double rounding_arcsec2, const TickInput& input, Gap& gap, HistoryTick& entry) noexcept {
    if (input.known.ticks <= 0 || input.known.ticks > gap.n - gap.known_ticks) return;
    entry.known = input.known;
    entry.read.variance_arcsec2 += input.known_drift_arcsec2;
    entry.read.relock_variance_arcsec2 = input.known_drift_arcsec2;
    if (!input.known.is_rough) count_in(rounding_arcsec2, input.known.ticks, input.known.variance_arcsec2, gap);
}

KnownShift settle_known(const CompensationConstants& gyro, const GapBridgeConfig& config, GapBridgeState& state,
                        Gap& gap, std::int64_t first, std::int64_t last, double constant_arcsec) noexcept {
    // The rows of a longer gap were delivered before the sum was known.
    const bool is_short = gap.n <= max_gap_ticks(config);
    KnownShift out;
    std::uint64_t covered = 0;  // one bit for each tick of a short gap
    double beside_arcsec2 = 0.0;
    for (std::int64_t t = first; t <= last; ++t) {
        HistoryTick& entry = at(state, t);
        const std::int64_t n = entry.known.ticks;
        if (n == 0) continue;
        entry.known.ticks = 0;
        const std::int64_t start = t + 1 - n;
        const std::int64_t begin = start < state.next_final ? state.next_final : start;
        const KnownStretch s{begin, t, begin - start, entry.known.arcsec, entry.read.variance_arcsec2};
        // What the bridge says of the stretch against its sum: its rows as if independent, and (3).
        double claimed_arcsec2 = 0.0;
        for (std::int64_t k = s.first; is_short && k <= s.last; ++k)
            claimed_arcsec2 += square(at(state, k).row.sigma_arcsec);
        const double off = is_short ? deficit_of(state, s, 0.0) : 0.0;
        const bool contradicts = square(off) > outlier_sq * (entry.known.variance_arcsec2 + s.n() * claimed_arcsec2);
        if (entry.known.is_rough) {
            if (!contradicts && !(entry.known.variance_arcsec2 < claimed_arcsec2)) continue;
            count_in(rounding_arcsec2(gyro, state.with_phase), n, entry.known.variance_arcsec2, gap);
            out.variance_arcsec2 += entry.known.variance_arcsec2;
        }
        if (is_short) covered |= ((std::uint64_t{1} << n) - 1u) << (t + 1 - n - gap.first_tick);
        if (contradicts) beside_arcsec2 += square(off);
        settle(state, gap, s, constant_arcsec, out.change_arcsec);
    }
    double n_beside = 0.0;
    for (std::int64_t j = 0; j < gap.n && beside_arcsec2 > 0.0; ++j) {
        if ((covered >> j & 1u) != 0) continue;
        double& sigma = at(state, gap.first_tick + j).row.sigma_arcsec;
        sigma = deviation(sigma * sigma + beside_arcsec2);
        n_beside += 1.0;
    }
    out.variance_arcsec2 += n_beside * n_beside * beside_arcsec2;
    return out;
}

}  // namespace zlg::core
