#include <zlg/core/coil_monitor.hpp>

#include <zlg/core/maths.hpp>

#include "bounds.hpp"

namespace zlg::core {
namespace {

constexpr std::int32_t coil_learning_halves = 64;
constexpr std::int32_t new_level_halves = 400;
constexpr double smoothed = 0.125;
constexpr double coil_followed = 1.0 / 1024.0;

// Mean size of a normal deviation is 0.8 of its standard one; two halves differ by sqrt 2 of that, smoothing leaves a quarter.
constexpr double eight_differences = 14.2;
constexpr double two_deviations = 2.5;

// Beyond, a current is damage; below, it is none.
constexpr double most_a = 1e9;
constexpr double least_a = 1e-6;

double larger(double x, double y) noexcept { return x > y ? x : y; }

// The first level of each sign, then their mean and how far a half is from it.
void learn(CoilMonitorState& s, std::size_t place, double current_a) noexcept {
    if (current_a < least_a) {
        s.n_learnt = 0;
        return;
    }
    double& level_a = s.level_a[place];
    const std::int32_t n = s.n_learnt / 2;
    const double deviation = s.n_learnt < 2 ? 0.0 : (current_a - level_a) / level_a;
    level_a = s.n_learnt < 2 ? current_a : level_a + (current_a - level_a) / (n + 1);
    if (n > 0) s.spread += (size(deviation) - s.spread) / (s.n_learnt - 1);
    // Not one level: begin again.
    s.n_learnt = size(deviation) < 0.1 ? s.n_learnt + 1 : 0;
    if (s.n_learnt == 0) s.spread = 0.0;
}

void follow(CoilMonitorState& s, std::size_t place, double current_a, double deviation) noexcept {
    s.level_a[place] += coil_followed * (current_a - s.level_a[place]);
    s.spread += coil_followed * (size(deviation) - s.spread);
    s.n_even = 0;
}

// Off in both signs alike, and as much as before: a supply that was replaced, or has aged at once.
void doubt(CoilMonitorState& s, bool alike) noexcept {
    s.n_even = alike ? s.n_even + 1 : 0;
    if (s.n_even < new_level_halves) return;
    for (double& level_a : s.level_a) level_a *= 1.0 + s.even;
    s.even = 0.0;
    s.n_even = 0;
}

}  // namespace

CoilMonitorOutput step(const CoilMonitorConfig& config, CoilMonitorState& state, int sign, double current_a) noexcept {
    CoilMonitorOutput out;
    const double now_a = size(current_a);
    if (!(config.tolerance_ratio > 0.0) || !(now_a < most_a)) return out;
    const std::size_t place = sign > 0 ? 1 : 0;
    if (state.n_learnt < coil_learning_halves) {
        learn(state, place, now_a);
        return out;
    }
    const double deviation = now_a / state.level_a[place] - 1.0;
    const double change = deviation - state.deviation;
    const double usual = eight_differences * state.spread;
    const double limit = larger(config.tolerance_ratio, usual);
    const bool jump = size(change) > limit;
    // A step of both signs alike is no difference of the signs: a difference of that size jumps in every half.
    if (!jump) state.odd += smoothed * (0.5 * sign * change - state.odd);
    state.even += smoothed * (deviation - state.even);
    state.deviation = deviation;
    const double limit_odd = larger(0.5 * config.tolerance_ratio, two_deviations * state.spread);
    out.unbalanced = jump || size(state.odd) > limit_odd;
    out.off = out.unbalanced || size(state.even) > limit_odd;
    if (out.off) {
        doubt(state, !out.unbalanced);
    } else {
        follow(state, place, now_a, deviation);
    }
    return out;
}

}  // namespace zlg::core
