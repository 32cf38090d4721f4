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
    if (!(threshold > 0.0)) return 0.0;
    const double plateaus = lost_on_plateau(b.first, threshold) + lost_on_plateau(b.second, threshold);
    const double ratio = threshold / (size(b.turn) > b.bias ? size(b.turn) : b.bias);
    return (1.0 - 2.0 * b.edge_ratio) * plateaus + 2.0 * b.edge_ratio * ratio * ratio * b.turn;
}

LostCounts lost_counts(const LockInConfig& config, double half_s, const Beats& b) noexcept {
    const double threshold = config.threshold.value() * half_s;
    const double largest = threshold + config.sigma.value() * half_s;
    LostCounts out{.value = lost(b, threshold)};
    out.variance = square(lost(b, largest) - out.value);
    const double standing = largest + reading_counts;
    if (size(b.first) < standing || size(b.second) < standing) out.variance += square(largest);
    return is_finite(out.value + out.variance) ? out : LostCounts{.variance = infinity};
}

Beats beats_of(const CompensationConstants& gyro, double tick_counts) noexcept {
    return {.edge_ratio = 1.0 - 1.0 / gyro.plateau_ratio,
            .turn = 0.5 * tick_counts,
            .bias = gyro.plateau_ratio * gyro.bias.value() * 0.5 * gyro.tick.value()};
}

}  // namespace

LockInFault check(const LockInConfig& config) noexcept {
    if (!is_within(config.threshold.value(), 0.0, max_threshold_hz)) return LockInFault::threshold;
    return is_within(config.sigma.value(), 0.0, max_threshold_hz) ? LockInFault::none : LockInFault::sigma;
}

LostCounts lost_to_lock_in(const CompensationConstants& gyro, const LockInConfig& config, double first_counts,
                           double second_counts) noexcept {
    Beats b = beats_of(gyro, first_counts + second_counts);
    b.first = gyro.plateau_ratio * (first_counts - b.edge_ratio * b.turn);
    b.second = gyro.plateau_ratio * (second_counts - b.edge_ratio * b.turn);
    return lost_counts(config, 0.5 * gyro.tick.value(), b);
}

LostCounts lost_to_lock_in(const CompensationConstants& gyro, const LockInConfig& config, double tick_counts,
                           Hertz bias) noexcept {
    Beats b = beats_of(gyro, tick_counts);
    const double plateau = gyro.plateau_ratio * bias.value() * 0.5 * gyro.tick.value();
    b.first = b.turn + plateau;
    b.second = b.turn - plateau;
    return lost_counts(config, 0.5 * gyro.tick.value(), b);
}

double unknown_loss_counts2(const CompensationConstants& gyro, const LockInConfig& config,
                            double tick_counts) noexcept {
    if (!(config.sigma.value() > 0.0)) return 0.0;
    const double half_s = 0.5 * gyro.tick.value();
    const double bias = gyro.plateau_ratio * gyro.bias.value() * half_s;
    const double threshold = config.sigma.value() * half_s / bias;
    const double x = 0.5 * tick_counts / bias;
    const double from_bias_sq = square(1.0 - x * x) + 4.0 * threshold * threshold;
    const double loss = bias * threshold * threshold * x;
    const double loss_sq = loss * loss / from_bias_sq;
    return is_finite(loss_sq) ? loss_sq : infinity;
}

}  // namespace zlg::core
