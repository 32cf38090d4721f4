#include <zlg/core/control/coil_monitor.hpp>

#include <zlg/core/common/maths.hpp>

#include "common/bounds.hpp"

namespace zlg::core {
namespace {

constexpr std::int32_t coil_learning_halves = 64;
constexpr std::int32_t new_level_halves = 400;
constexpr double smoothed = 0.125;
constexpr double coil_followed = 1.0 / 1024.0;

// Mean size of a normal deviation is 0.8 of its standard one; two halves differ by sqrt 2 of that, smoothing leaves a
// quarter.
constexpr double eight_differences = 14.2;
constexpr double two_deviations = 2.5;

// A difference of the signs of one per cent is damage whatever was learnt.
constexpr double most_asymmetry = 0.005;
// Four deviations of a noise of one per cent, until it is known.
constexpr double first_asymmetry = 0.03;

// Beyond, a current is damage; below, it is none.
constexpr double max_a = 1e9;
constexpr double min_a = 1e-6;

// Difference of the two signs over their sum.
double asymmetry(double negative_a, double positive_a) noexcept {
    return size(positive_a - negative_a) / (positive_a + negative_a);
}

// Whether the signs differ, in absolute terms, by more than a limit and two deviations.
bool are_apart(const CoilMonitorState& s, double limit_ratio) noexcept {
    const auto& [negative_a, positive_a] = s.level_a;
    const double limit = limit_ratio + 0.5 * two_deviations * s.spread;
    return size(positive_a - negative_a) > limit * (positive_a + negative_a);
}

// The first level of each sign, then their mean and how far a half is from it; returns whether the signs differ.
bool learn(CoilMonitorState& s, std::size_t place, double current_a) noexcept {
    const auto& [negative_a, positive_a] = s.level_a;
    if (larger(current_a, s.level_a[1 - place]) < min_a) return false;
    double& level_a = s.level_a[place];
    const std::int32_t n = s.n_learnt / 2;
    if (n == 0) level_a = current_a;
    const double deviation = 2.0 * (current_a - level_a) / (negative_a + positive_a);
    level_a += (current_a - level_a) / (n + 1);
    if (n > 0) s.spread += (size(deviation) - s.spread) / (s.n_learnt - 1);
    const bool jump = size(deviation) >= 0.1;
    const bool unbalanced = jump || (s.n_learnt > 0 && are_apart(s, n < 2 ? first_asymmetry : most_asymmetry));
    // Not one level: begin again. What differs is not learnt.
    if (!unbalanced || s.n_learnt == 0) ++s.n_learnt;
    if (jump) s.n_learnt = 0;
    if (s.n_learnt == 0) s.spread = 0.0;
    if (s.n_learnt == coil_learning_halves) s.first_a = s.level_a;
    return unbalanced;
}

void follow(CoilMonitorState& s, std::size_t place, double current_a, double deviation) noexcept {
    s.level_a[place] += coil_followed * (current_a - s.level_a[place]);
    s.spread += coil_followed * (size(deviation) - s.spread);
    s.n_steady = 0;
}

// The means of both signs since the current is off and steady; halves in a row.
std::int32_t watch(CoilMonitorState& s, std::size_t place, double current_a, double limit_ratio) noexcept {
    double& mean_a = s.steady_a[place];
    const bool first = s.n_steady < 2;
    const bool steady = first || size(current_a - mean_a) <= limit_ratio * s.level_a[place];
    s.n_steady = steady ? s.n_steady + 1 : 1;
    mean_a = first || !steady ? current_a : mean_a + 2.0 * (current_a - mean_a) / s.n_steady;
    return s.n_steady;
}

constexpr double max_change = 2.0;

bool are_over_half(const std::array<double, 2>& a, const std::array<double, 2>& b) noexcept {
    return max_change * a[0] > b[0] && max_change * a[1] > b[1];
}

bool are_near(const std::array<double, 2>& a, const std::array<double, 2>& b) noexcept {
    return are_over_half(a, b) && are_over_half(b, a);
}

// Off and steady: a supply that was replaced, or has aged at once, or levels that were learnt while it was faulty. Less
// than half of the current is none of these, unless that was learnt first and a reading too high later; nor is a
// difference of the signs that was not there.
void learn_anew(CoilMonitorState& s, double tolerance_ratio) noexcept {
    s.n_steady = 0;
    const auto& [negative_a, positive_a] = s.steady_a;
    const auto& [was_negative_a, was_positive_a] = s.level_a;
    if (!are_over_half(s.steady_a, s.level_a) && !are_near(s.steady_a, s.first_a)) return;
    const double odd = 0.5 * (positive_a / was_positive_a - negative_a / was_negative_a);
    const double less = asymmetry(was_negative_a, was_positive_a) - asymmetry(negative_a, positive_a);
    if (!(size(odd) <= 0.5 * tolerance_ratio || less > 0.5 * tolerance_ratio)) return;
    // Noise is that of the reading, whatever the current.
    s.spread *= (was_negative_a + was_positive_a) / (negative_a + positive_a);
    s.level_a = s.steady_a;
    s.even = s.odd = s.deviation = 0.0;
}

}  // namespace

CoilMonitorOutput step(const MonitorLimits& limits, CoilMonitorState& state, int sign, double current_a) noexcept {
    CoilMonitorOutput out;
    const double now_a = size(current_a);
    if (!(limits.coil_ratio > 0.0) || !(now_a < max_a)) return out;
    const std::size_t place = sign > 0 ? 1 : 0;
    if (state.n_learnt < coil_learning_halves) {
        out.off = out.unbalanced = learn(state, place, now_a);
        return out;
    }
    const double deviation = now_a / state.level_a[place] - 1.0;
    const double change = deviation - state.deviation;
    const double usual = eight_differences * state.spread;
    const double limit = larger(limits.coil_ratio, usual);
    const bool jump = size(change) > limit;
    // A step of both signs alike is no difference of the signs: a difference of that size jumps in every half.
    if (!jump) state.odd += smoothed * (0.5 * sign * change - state.odd);
    state.even += smoothed * (deviation - state.even);
    state.deviation = deviation;
    const double limit_odd = larger(0.5 * limits.coil_ratio, two_deviations * state.spread);
    out.unbalanced = jump || size(state.odd) > limit_odd ||
                     size(state.level_a[1] - state.level_a[0]) > 2.0 * most_asymmetry * state.level_a[0];
    out.off = out.unbalanced || size(state.even) > limit_odd;
    if (out.off) {
        const bool is_new = watch(state, place, now_a, limit) >= new_level_halves;
        if (is_new) learn_anew(state, 2.0 * limit_odd);
    } else {
        follow(state, place, now_a, deviation);
    }
    return out;
}

}  // namespace zlg::core
