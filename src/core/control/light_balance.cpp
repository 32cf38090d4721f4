#include <zlg/core/control/light_balance.hpp>

#include <zlg/core/common/maths.hpp>

#include "common/bounds.hpp"

namespace zlg::core {
namespace {

constexpr double max_change = 0.0133;
constexpr double max_fade = 0.2;

// Ticks of a settled gyro, of which one in four is followed: ten seconds.
constexpr std::int32_t max_faded = 500;

// A beam that is a hundred times as bright as the other one is no inequality of photodiodes.
constexpr double max_weight = 100.0;

// Change of S over a tick up to which the detuning stands: what it falls by from half to half is then nothing in a
// mean.
constexpr double max_fall = 0.01;

// h from which on an offset is learnt. Of light that hardly falls with the detuning it does less.
constexpr double min_change = 0.1;

// An offset of photodiodes whose dark light nobody has subtracted, before a jump was seen.
constexpr double presumed_offset = 0.03;

// What an offset may change by from one re-lock to the next, as a variance.
constexpr double offset_wander = 1e-10;

// Jumps that are together so many times their deviation say that the offset was presumed to be known too well: of fifty
// jumps, ten re-locks, an offset of .004.
constexpr double surprise_sq = 16.0;
constexpr double forgotten = 0.02;

// Of the light, where the bias is reversed: its part that has fallen, and S^2. As the detuning falls evenly, both are
// the geometric means of those of the halves beside.
double fallen(double level, double light) noexcept { return level > light ? level / light - 1.0 : 0.0; }

double border_signal_sq(const LightBalanceState& s, const BalancedHalf& half) noexcept {
    const double square = -s.last_signal * half.signal;
    return square > 0.0 ? square : 0.0;
}

// (2), for F' = 1.
double jump_per_offset(const LightBalanceState& s, const BalancedHalf& half, double signal_per_lambda) noexcept {
    if (!(s.has_last && s.n_ticks >= known_ticks && s.last_light > 0.0 && half.light > 0.0)) return 0.0;
    const double part = square_root(fallen(s.level, s.last_light) * fallen(s.level, half.light));
    return (part + border_signal_sq(s, half)) / signal_per_lambda;
}

bool is_possible(double weight) noexcept { return weight < max_weight && weight > 1.0 / max_weight; }

void learn_weight(const MonitorLimits& limits, LightBalanceState& s, const BalancedHalf& half) noexcept {
    if (s.n_ticks < limits.balance_ticks) s.n_ticks += 1.0;
    const double n = s.n_ticks < balance_memory_ticks ? s.n_ticks : balance_memory_ticks;
    const double odd = limited(0.5 * (s.last_signal + half.signal), 0.5);
    // What leaps is no drift.
    const bool leaps = n < balance_memory_ticks || size(odd) > max_change;
    const double drift = leaps ? 0.0 : s.drift + balance_drift_gain * odd;
    const double step = odd / n + drift;
    const double weight = s.weight * (1.0 + step) / (1.0 - step);
    // A beam that fades within minutes by more than a fifth comes back: followed all the way, it would then be too
    // bright.
    const bool is_near = n < balance_memory_ticks || size(weight - s.slow_weight) < max_fade * s.slow_weight ||
                         size(weight - s.slow_weight) < size(s.weight - s.slow_weight);
    if (is_near && is_possible(weight)) {
        s.weight = weight;
        s.drift = drift;
    }
    s.level += (half.light - s.level) / n;
    s.slow_weight += (s.weight - s.slow_weight) / s.n_ticks;
    s.changes = s.n_ticks >= balance_memory_ticks && size(s.weight - s.slow_weight) > max_change * s.slow_weight;
}

// Most beams that fade come back soon, and are then as they were.
bool teaches(LightBalanceState& s, const BalancedHalf& half) noexcept {
    if (s.n_ticks < known_ticks) return true;
    if (half.settles) return false;
    if (!half.has_faded) s.n_faded = 0;
    if (!half.has_faded || s.n_faded >= max_faded) return true;
    ++s.n_faded;
    return false;
}

}  // namespace

double unknown_jump_lambda2(const LightBalanceState& state, const BalancedHalf& half,
                            double signal_per_lambda) noexcept {
    if (state.n_ticks < known_ticks) return 1.0;  // any jump
    const double unseen = 1.0 / (state.weights + 1.0 / square(presumed_offset));
    return unseen * square(jump_per_offset(state, half, signal_per_lambda));
}

void learn_offset(LightBalanceState& state, const BalancedHalf& half, const DetuningJump& jump,
                  double signal_per_lambda) noexcept {
    const SeenJump before = state.seen;
    state.seen = {.lambda = jump.lambda,
                  .per_offset = square_root(jump.slope_sq) * jump_per_offset(state, half, signal_per_lambda),
                  .variance_lambda2 = jump.variance_lambda2,
                  .signal_sq = border_signal_sq(state, half),
                  .behind = half.signal};
    if (before.behind != state.last_signal || !(state.seen.signal_sq < before.signal_sq)) return;
    const double ratio = square_root(state.seen.signal_sq / before.signal_sq);
    const double h = state.seen.per_offset + ratio * before.per_offset;
    const double j = state.seen.lambda + ratio * before.lambda;
    const double r = state.seen.variance_lambda2 + square(ratio) * before.variance_lambda2;
    if (!(h > min_change)) return;
    state.jumps = (1.0 - forgotten) * state.jumps + h / r * j;
    state.weights = (1.0 - forgotten) * state.weights + h / r * h;
    if (square(state.jumps) > surprise_sq * state.weights * (1.0 + state.variance * state.weights)) {
        state.variance = square(state.jumps / state.weights);
        state.jumps = state.weights = 0.0;
    }
    const double gain = state.variance * h / (square(h) * state.variance + r);
    const double half_level = 0.5 * state.level / state.weight;  // of B
    const double more = limited(-gain * j, 0.2) * half_level;
    // The beams stay equal at the centre.
    const double new_weight = state.weight * half_level / (half_level - more);
    // An offset of more than half the light is none of a photodiode; false for NaN.
    if (!(size(state.offset + more) < half_level && is_possible(new_weight))) return;
    state.variance += offset_wander - gain * h * state.variance;
    state.offset += more;
    state.slow_weight *= new_weight / state.weight;
    state.weight = new_weight;
}

void follow(const MonitorLimits& limits, LightBalanceState& state, const BalancedHalf& half) noexcept {
    const bool stands = size(half.signal - state.former_signal) < max_fall;
    if (!half.is_first && half.is_read && state.has_last && stands && teaches(state, half))
        learn_weight(limits, state, half);
    state.former_signal = half.is_read ? state.last_signal : 1.0;
    state.has_last = half.is_read;
    state.last_signal = half.signal;
    state.last_light = half.light;
}

}  // namespace zlg::core
