#include <zlg/calibration/angle_scatter.hpp>

#include <cmath>

namespace zlg::calibration {
namespace {

constexpr double standing_rounding_counts2 = 0.25;  // A(n) of the rounding alone, see the header
// A variance from this many pairs is known to a third.
constexpr std::int64_t min_pairs = 16;
// A gyro at rest has no more than this times the expected variance, and no less than the inverse.
constexpr double max_ratio = 4.0;

}  // namespace

void AngleScatter::interrupt() { level_ = {}; }

void AngleScatter::take(std::int64_t counts) {
    auto sum = static_cast<double>(counts);
    for (std::size_t scale = 0; scale < level_.size(); ++scale) {
        Level& level = level_[scale];
        if (level.has_previous) {
            const double change = sum - level.previous;
            sum_[scale] += 0.5 * change * change;
            ++pairs_[scale];
        }
        level.previous = sum;
        level.has_previous = true;
        level.has_half = !level.has_half;
        if (level.has_half) {
            level.half = sum;
            return;
        }
        sum += level.half;
    }
}

void AngleScatter::add(const AngleScatter& other) {
    for (std::size_t scale = 0; scale < pairs_.size(); ++scale) {
        pairs_[scale] += other.pairs_[scale];
        sum_[scale] += other.sum_[scale];
    }
}

double AngleScatter::variance(int scale) const {
    const auto k = static_cast<std::size_t>(scale);
    return pairs_[k] > 0 ? sum_[k] / static_cast<double>(pairs_[k]) : 0.0;
}

RestCheck check_rest(const AngleScatter& scatter, double walk_counts2_per_tick) {
    RestCheck result;
    double worst = 0.0;
    for (int scale = 0; scale < scatter_scales; ++scale) {
        if (scatter.pairs(scale) < min_pairs) continue;
        const std::int64_t ticks = std::int64_t{1} << scale;
        const double walk = walk_counts2_per_tick * static_cast<double>(ticks);
        const double ratio = scatter.variance(scale) / (standing_rounding_counts2 + walk);
        if (ratio < 1.0 && walk < 4.0 * standing_rounding_counts2) continue;
        const double distance = std::abs(std::log(std::fmax(ratio, 1e-12)));
        if (!(distance > worst)) continue;
        worst = distance;
        result = {
            .at_rest = !(ratio > max_ratio || ratio < 1.0 / max_ratio), .worst_ratio = ratio, .worst_ticks = ticks};
    }
    return result;
}

}  // namespace zlg::calibration
