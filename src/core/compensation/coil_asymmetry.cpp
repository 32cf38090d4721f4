#include <zlg/core/compensation/coil_asymmetry.hpp>

#include <cstddef>

#include "common/bounds.hpp"

namespace zlg::core {
namespace {

constexpr std::array<double, n_recent_means> recent_ticks{4.0, 16.0, 64.0, 256.0, 1024.0};

// Ticks of a plain mean with the variance of an exponential one. Those made of every fourth value of the shortest have up to a tenth more.
constexpr double equivalent_ticks(std::size_t k) noexcept {
    return (2.0 * recent_ticks[k] - 1.0) / (k > 0 ? 1.1 : 1.0);
}

// Squares of numbers of standard deviations.
constexpr double change_gate_sq = 36.0;
constexpr double near_sq = 4.0;

// Logarithm of the ratio of the likelihoods at which the usual asymmetry is back (cumulative sum, Page 1954).
constexpr double return_evidence = 12.0;

// By these the noise is known to 12 %.
constexpr double learning_ticks = 64.0;
constexpr double noise_ticks = 1024.0;
constexpr double max_noise_ratio = 16.0;  // of one square over the mean
constexpr std::int32_t forgetting_ticks = 400;

// A single wrong reading is no change.
constexpr double trusted_ticks = 3.0;

// With noise of 0.7 of the converter's step a fifth of the ticks repeat the one before; with less a mean does not tell parts of the step.
constexpr double max_repeated = 0.2;

// No coil has less, and no reading is more.
constexpr double min_a = 1e-6;
constexpr double max_a = 1e9;

constexpr double squared(double x) noexcept { return x * x; }

void add(MeanAsymmetry& mean, double ratio) noexcept {
    if (mean.n_ticks < coil_mean_ticks) mean.n_ticks += 1.0;
    mean.ratio += (ratio - mean.ratio) / mean.n_ticks;
}

void learn_noise(CoilAsymmetryState& s, double ratio) noexcept {
    const double found = 0.5 * squared(ratio - s.last_ratio);
    const double repeated = ratio == s.last_ratio ? 1.0 : 0.0;
    s.last_ratio = ratio;
    // A step is no noise.
    const double most = s.n_differences < learning_ticks ? found : max_noise_ratio * s.variance;
    if (s.n_differences < noise_ticks) s.n_differences += 1.0;
    s.variance += ((found < most ? found : most) - s.variance) / s.n_differences;
    s.repeated += (repeated - s.repeated) / s.n_differences;
}

// A change is soonest seen by a mean that holds it in part; the next shorter one, or the last tick, holds it nearly whole.
void begin_anew(CoilAsymmetryState& s, std::size_t seen_by, double ratio) noexcept {
    s.change = {.ratio = ratio, .n_ticks = 1.0};
    if (seen_by > 0) s.change = {.ratio = s.recent[seen_by - 1], .n_ticks = equivalent_ticks(seen_by - 1)};
    for (std::size_t k = seen_by; k < s.recent.size(); ++k) s.recent[k] = s.change.ratio;
    s.return_sq = 0.0;
}

// Moves one of the means, and asks whether it is off the level.
bool is_off(CoilAsymmetryState& s, const MeanAsymmetry& level, std::size_t k, double ratio, double weight) noexcept {
    double& mean = s.recent[k];
    mean += weight * (ratio - mean);
    return squared(mean - level.ratio) >
           change_gate_sq * s.variance * (1.0 / equivalent_ticks(k) + 1.0 / level.n_ticks);
}

// Returns whether a new level has begun, this tick in it.
bool has_changed(CoilAsymmetryState& s, double ratio) noexcept {
    const MeanAsymmetry level = s.change.n_ticks > 0.0 ? s.change : s.usual;
    // A mean that is younger than its memory is that of the level.
    const double age_ticks = level.n_ticks + 1.0;
    std::size_t k = 0;
    if (!is_off(s, level, k, ratio, 1.0 / (age_ticks < recent_ticks[k] ? age_ticks : recent_ticks[k]))) {
        // The longer ones take turns, each once in four ticks, and are made of the shortest.
        s.turn = s.turn < n_recent_means - 1 ? s.turn + 1 : 1;
        k = s.turn;
        const double memory_ticks = age_ticks < recent_ticks[k] ? age_ticks : recent_ticks[k];
        const double weight = memory_ticks > recent_ticks[0] ? recent_ticks[0] / memory_ticks : 1.0;
        if (!is_off(s, level, k, s.recent[0], weight)) return false;
    }
    begin_anew(s, k, ratio);
    return true;
}

double variance_of_change(const CoilAsymmetryState& s) noexcept {
    return s.variance * (1.0 / s.change.n_ticks + 1.0 / s.usual.n_ticks);
}

// Tick by tick the usual value against that since the change.
bool has_returned(CoilAsymmetryState& s, double ratio) noexcept {
    s.return_sq += squared(ratio - s.change.ratio) - squared(ratio - s.usual.ratio);
    if (s.return_sq < 0.0) s.return_sq = 0.0;
    return s.return_sq > 2.0 * return_evidence * s.variance;
}

// Over, or the usual asymmetry was that of a fault.
void look_for_end(CoilAsymmetryState& s, double ratio) noexcept {
    const double variance = variance_of_change(s);
    const bool is_over = has_returned(s, ratio) || squared(s.change.ratio - s.usual.ratio) <= near_sq * variance;
    const double less = size(s.usual.ratio) - size(s.change.ratio);
    const bool is_better = less > 0.0 && squared(less) > change_gate_sq * variance;
    if (is_better) s.usual = s.change;
    if (!is_over && !is_better) return;
    s.change = {};
    s.recent.fill(s.usual.ratio);
}

bool is_read(const HalfRecord& half) noexcept {
    const double now_a = size(half.coil_current_a);
    return now_a > min_a && now_a < max_a;
}

void follow(CoilAsymmetryState& s, double ratio) noexcept {
    if (s.n_differences < 1.0) s.last_ratio = ratio;
    learn_noise(s, ratio);
    if (s.usual.n_ticks < learning_ticks) {
        add(s.usual, ratio);
        s.recent.fill(s.usual.ratio);
        return;
    }
    if (!has_changed(s, ratio)) add(s.change.n_ticks > 0.0 ? s.change : s.usual, ratio);
    if (s.change.n_ticks > 0.0) look_for_end(s, ratio);
}

}  // namespace

CoilAsymmetry step(CoilAsymmetryState& state, const HalfRecord& first, const HalfRecord& second) noexcept {
    if (is_read(first) && is_read(second) && first.bias_sign != second.bias_sign) {
        state.n_unknown = 0;
        const double first_a = size(first.coil_current_a);
        const double second_a = size(second.coil_current_a);
        follow(state, first.bias_sign * (first_a - second_a) / (first_a + second_a));
    } else {
        count_up(state.n_unknown);
        if (state.n_unknown >= forgetting_ticks) state = {};
    }
    if (!(state.change.n_ticks >= trusted_ticks) || state.repeated > max_repeated) return {};
    return {state.change.ratio - state.usual.ratio, variance_of_change(state)};
}

}  // namespace zlg::core
