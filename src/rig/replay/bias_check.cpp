#include <zlg/rig/bias_check.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace zlg::rig {
namespace {

// The control sees a mode of the other helicity within 4 halves, and follows it within 20.
constexpr int lasting_halves = 32;

// Below, roundings and an ordinary rotation hide the bias.
constexpr double min_bias_counts = 16.0;

int beat_sign(const core::HalfRecord& half) { return half.bias_sign * half.mode; }

}  // namespace

BiasCheck::BiasCheck(const core::CompensationConstants& gyro)
    : presumed_counts_{gyro.bias.value() * 0.5 * gyro.tick.value()},
      least_counts_{std::max(min_bias_counts, 0.25 * presumed_counts_)} {}

void BiasCheck::take(const core::HalfRecord& half) {
    const bool measured = core::is_measured(half);
    if (measured && has_last_ && half.mode == last_.mode && half.bias_sign != last_.bias_sign) compare({last_, half});
    last_ = half;
    has_last_ = measured;
}

// As many counts as the bias makes, in one direction, in halves of both signs.
bool BiasCheck::counts_one_way(const Pair& pair) const {
    const auto before = static_cast<double>(pair.before.counts), after = static_cast<double>(pair.half.counts);
    const double least = std::max(min_bias_counts, 0.5 * presumed_counts_);
    return before * after > 0.0 && std::fabs(before) >= least && std::fabs(after) >= least &&
           std::fabs(after - before) < 2.0 * least_counts_;
}

void BiasCheck::compare(const Pair& pair) {
    ++n_pairs_;
    if (counts_one_way(pair) && ++n_one_way_ == 1) first_one_way_ = pair;
    const double change = static_cast<double>(pair.half.counts) - static_cast<double>(pair.before.counts);
    if (change == 0.0) ++n_equal_;
    const double bias_counts = 0.5 * beat_sign(pair.half) * change;
    if (bias_counts > -least_counts_ && bias_counts < least_counts_) return;
    ++n_judged_;
    if (bias_counts > 0.0) {
        n_in_a_row_ = 0;
        return;
    }
    ++n_wrong_;
    if (n_in_a_row_ == 0) first_in_row_ = pair;
    n_in_a_row_ = std::min(n_in_a_row_ + 1, lasting_halves);
    if (n_in_a_row_ < lasting_halves || lasts_) return;
    lasts_ = true;
    first_wrong_ = first_in_row_;
}

std::string BiasCheck::complaint(const std::string& log_name) const {
    if (!lasts_ && n_pairs_ >= lasting_halves && 20 * n_one_way_ >= 19 * n_pairs_)
        return fmt::format(
            "{}: the bias of {:.6g} counts in a half-period does not show: in {} of {} pairs of half-periods of "
            "opposite "
            "bias_sign the counts have one direction, {} and then {} in half-periods {} and {}; the direction of the "
            "counter may be missing, and the angle is wrong then",
            log_name, presumed_counts_, n_one_way_, n_pairs_, first_one_way_.before.counts, first_one_way_.half.counts,
            first_one_way_.before.half, first_one_way_.half.half);
    if (!lasts_ && n_pairs_ >= lasting_halves && 20 * n_equal_ >= 19 * n_pairs_ && presumed_counts_ >= 1.0)
        return fmt::format(
            "{}: the counter stands still: in {} of {} pairs of half-periods of opposite bias_sign the "
            "counts are equal, and {:.6g} of bias are presumed in each; the angle is no measurement",
            log_name, n_equal_, n_pairs_, presumed_counts_);
    if (!lasts_) return {};
    const auto& [before, half] = first_wrong_;
    return fmt::format(
        "{}: the columns mode and bias_sign contradict the counts in {} of {} half-periods that show the bias, first "
        "in "
        "half-period {}: bias_sign * mode is {:+d} and then {:+d}, and the counts are {} and then {}; right are more "
        "counts "
        "where bias_sign * mode is +1. The correction after re-lock has the wrong sign there, and a switch that mode "
        "does not show is taken for an open loop",
        log_name, n_wrong_, n_judged_, before.half, beat_sign(before), beat_sign(half), before.counts, half.counts);
}

}  // namespace zlg::rig
