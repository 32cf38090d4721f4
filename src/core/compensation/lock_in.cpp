#include <zlg/core/compensation/lock_in.hpp>

#include <zlg/core/common/maths.hpp>

#include "common/bounds.hpp"

namespace zlg::core {
namespace {

constexpr double max_threshold_hz = 1e9;

// A reading is off by less than a count, and so is the beat of a half.
constexpr double reading_counts = 1.0;

// threshold  as counts in T/2.
//
// A beat of less than a count may stand still, and then has no sign: nothing is given back, and the variance holds all.
double lost_on_plateau(double beat, double threshold) noexcept {
    if (size(beat) < reading_counts) return 0.0;
    const double lost = threshold * threshold / (size(beat) + square_root(square(beat) + square(threshold)));
    return beat < 0.0 ? -lost : lost;
}

}  // namespace

bool is_allowed(const LockInConfig& config) noexcept {
    return is_within(config.threshold.value(), 0.0, max_threshold_hz) &&
           is_within(config.sigma.value(), 0.0, max_threshold_hz);
}

LostCounts lost_to_lock_in(const CompensationConstants& gyro, const LockInConfig& config, double first_counts,
                           double second_counts) noexcept {
    const double half_s = 0.5 * gyro.tick.value();
    const double edge_ratio = 1.0 - 1.0 / gyro.plateau_ratio;  // t_e/T
    const double turn = 0.5 * (first_counts + second_counts);  // r T/2
    // Beats of both plateaus, and f0, as counts in T/2.
    const double first = gyro.plateau_ratio * (first_counts - edge_ratio * turn);
    const double second = gyro.plateau_ratio * (second_counts - edge_ratio * turn);
    const double bias = gyro.plateau_ratio * gyro.bias.value() * half_s;
    const auto lost = [&](double threshold) {
        const double plateaus = lost_on_plateau(first, threshold) + lost_on_plateau(second, threshold);
        const double ratio = threshold / (size(turn) > bias ? size(turn) : bias);
        return (1.0 - 2.0 * edge_ratio) * plateaus + 2.0 * edge_ratio * ratio * ratio * turn;
    };
    const double threshold = config.threshold.value() * half_s, sigma = config.sigma.value() * half_s;
    LostCounts out;
    if (threshold > 0.0) {
        const double largest = threshold + sigma, standing = largest + reading_counts;
        out.value = lost(threshold);
        out.variance = square(lost(largest) - out.value);
        if (size(first) < standing || size(second) < standing) out.variance += square(largest);
    } else if (sigma > 0.0) {
        // Square of what a threshold as large as its sigma would take. Without the edges, and with 1 - (r/f0)^2 kept
        // from 0 by the width of the locked rates: a half that stands may lack twice its root.
        const double ratio = sigma / bias, x = turn / bias;
        out.variance = square(bias * ratio * ratio * x) / (square(1.0 - x * x) + 4.0 * ratio * ratio);
    }
    return is_finite(out.value + out.variance) ? out : LostCounts{.variance = infinity};
}

}  // namespace zlg::core
