#include <zlg/core/control/light_balance.hpp>

#include <zlg/core/common/maths.hpp>

#include "common/bounds.hpp"

namespace zlg::core {
namespace {

// A beam that is a hundred times as bright as the other one is no inequality of photodiodes.
constexpr double max_weight = 100.0;

// Change of S over a tick up to which the detuning stands: what it falls by from half to half is then nothing in a mean.
constexpr double max_fall = 0.01;

void learn_from(const LightBalanceConfig& config, LightBalanceState& state, const LightBalanceInput& in) noexcept {
    if (state.n_ticks < config.slow_ticks) state.n_ticks += 1.0;
    const double n = state.n_ticks < config.memory_ticks ? state.n_ticks : config.memory_ticks;
    const double odd = limited(0.5 * (state.last_signal + in.signal), 0.5) / n;
    const double weight = state.weight * (1.0 + odd) / (1.0 - odd);
    if (weight < max_weight && weight > 1.0 / max_weight) state.weight = weight;
    state.level += (in.light - state.level) / n;
    state.slow_weight += (state.weight - state.slow_weight) / state.n_ticks;
}

// h from which on the kinks of a digital loop, of .002 wavelength, are not taken for an offset. Of light that hardly falls with the
// detuning an offset does less.
constexpr double min_change = 0.1;

// That of photodiodes whose dark light nobody has subtracted, before a jump was seen.
constexpr double presumed_offset = 0.03;

// What an offset may change by from one re-lock to the next, as a variance.
constexpr double offset_wander = 1e-10;

// Jumps of so many times their deviation, together, say that what is known of the offset was presumed too well. Of fifty jumps, ten
// re-locks: an offset of .004.
constexpr double surprise_sq = 16.0;
constexpr double forgotten = 0.02;

// A half's part of the sum of (2).
double form_of(const LightBalanceState& state, const LightBalanceInput& in) noexcept {
    if (!(in.light > 0.0 && state.level > 0.0)) return 0.0;
    return 0.5 * (1.0 + in.signal) * (state.level / in.light - 1.0 + in.signal);
}

double change_per_offset(const LightBalanceState& state, const LightBalanceInput& in) noexcept {
    return (state.last_form + form_of(state, in)) / in.signal_per_lambda;
}

void learn_offset(LightBalanceState& state, const LightBalanceInput& in) noexcept {
    const double h = square_root(in.jump.slope_sq) * change_per_offset(state, in);
    if (!(size(h) > min_change)) return;
    const double weight = h / in.jump.variance_lambda2;
    state.jumps = (1.0 - forgotten) * state.jumps + weight * in.jump.lambda;
    state.weights = (1.0 - forgotten) * state.weights + weight * h;
    if (square(state.jumps) > surprise_sq * state.weights * (1.0 + state.variance * state.weights)) {
        state.variance = square(state.jumps / state.weights);
        state.jumps = state.weights = 0.0;
    }
    const double gain = state.variance * h / (square(h) * state.variance + in.jump.variance_lambda2);
    const double half_level = 0.5 * state.level / state.weight;  // of B
    const double more = limited(-gain * in.jump.lambda, 0.2) * half_level;
    if (!is_finite(more)) return;
    state.variance *= 1.0 - gain * h;
    state.variance += offset_wander;
    state.offset += more;
    // The beams stay equal at the centre.
    state.weight *= half_level / (half_level - more);
}

}  // namespace

std::span<const float> balanced(const LightBalanceState& state, std::span<const float> beam_b,
                                std::span<float, max_light_samples> room) noexcept {
    const auto weight = static_cast<float>(state.weight);
    const auto beyond = static_cast<float>(state.weight * state.offset);
    for (std::size_t k = 0; k < beam_b.size(); ++k) room[k] = weight * beam_b[k] - beyond;
    return room.first(beam_b.size());
}

double unknown_jump_lambda2(const LightBalanceState& state, const LightBalanceInput& input) noexcept {
    const double unseen = 1.0 / (state.weights + 1.0 / square(presumed_offset));
    return state.has_last ? unseen * square(change_per_offset(state, input)) : 0.0;
}

bool learn(const LightBalanceConfig& config, LightBalanceState& state, const LightBalanceInput& input) noexcept {
    if (state.has_last && input.is_read) {
        const bool stands = size(input.signal - state.former_signal) < max_fall;
        if (!input.is_first && stands) learn_from(config, state, input);
        if (input.jump.known && state.level > 0.0) learn_offset(state, input);
    }
    state.has_last = input.is_read;
    state.former_signal = input.is_read ? state.last_signal : 1.0;
    state.last_signal = input.signal;
    state.last_form = form_of(state, input);
    return state.n_ticks >= config.memory_ticks &&
           size(state.weight - state.slow_weight) > config.max_change * state.slow_weight;
}

}  // namespace zlg::core
