#include <zlg/core/compensation/lock_in.hpp>

#include <zlg/core/common/maths.hpp>

#include "common/bounds.hpp"

namespace zlg::core {
namespace {

constexpr double max_threshold_hz = 1e9;

// A reading is off by less than a count, and so is the beat of a half.
constexpr double reading_counts = 1.0;

// Beats of both plateaus, as counts in T/2.
struct Beats {
    double first = 0.0;
    double second = 0.0;
    double edge_ratio = 0.0;  // t_e/T
    double turn = 0.0;        // r T/2
    double bias = 0.0;        // f0 T/2
};

// threshold  as counts in T/2.
//
// A beat of less than a count may stand still, and then has no sign: nothing is given back, and the variance holds all.
double lost_on_plateau(double beat, double threshold) noexcept {
    if (size(beat) < reading_counts) return 0.0;
    const double lost = threshold * threshold / (size(beat) + square_root(square(beat) + square(threshold)));
    return beat < 0.0 ? -lost : lost;
}

double lost(const Beats& b, double threshold) noexcept {
    const double plateaus = lost_on_plateau(b.first, threshold) + lost_on_plateau(b.second, threshold);
    const double ratio = threshold / (size(b.turn) > b.bias ? size(b.turn) : b.bias);
    return (1.0 - 2.0 * b.edge_ratio) * plateaus + 2.0 * b.edge_ratio * ratio * ratio * b.turn;
}

// Square of what a threshold as large as its sigma would take. Without the edges, and with 1 - (r/f0)^2 kept from 0 by the width of
// the locked rates: a half that stands may lack twice its root.
double likely_loss_sq(const Beats& b, double sigma) noexcept {
    const double ratio = sigma / b.bias;
    const double x = b.turn / b.bias;
    return square(b.bias * ratio * ratio * x) / (square(1.0 - x * x) + 4.0 * ratio * ratio);
}

}  // namespace

bool is_allowed(const LockInConfig& config) noexcept {
    return is_within(config.threshold.value(), 0.0, max_threshold_hz) &&
           is_within(config.sigma.value(), 0.0, max_threshold_hz);
}

LostCounts lost_to_lock_in(const CompensationConstants& gyro, const LockInConfig& config, double first_counts,
                           double second_counts) noexcept {
    const double half_s = 0.5 * gyro.tick.value();
    const double edge_ratio = 1.0 - 1.0 / gyro.plateau_ratio;
    const double turn = 0.5 * (first_counts + second_counts);
    const Beats b{.first = gyro.plateau_ratio * (first_counts - edge_ratio * turn),
                  .second = gyro.plateau_ratio * (second_counts - edge_ratio * turn),
                  .edge_ratio = edge_ratio,
                  .turn = turn,
                  .bias = gyro.plateau_ratio * gyro.bias.value() * half_s};
    const double threshold = config.threshold.value() * half_s, sigma = config.sigma.value() * half_s;
    LostCounts out;
    if (threshold > 0.0) {
        const double largest = threshold + sigma, standing = largest + reading_counts;
        out.value = lost(b, threshold);
        out.variance = square(lost(b, largest) - out.value);
        if (size(b.first) < standing || size(b.second) < standing) out.variance += square(largest);
    } else if (sigma > 0.0) {
        out.variance = likely_loss_sq(b, sigma);
    }
    return is_finite(out.value + out.variance) ? out : LostCounts{.variance = infinity};
}

}  // namespace zlg::core
