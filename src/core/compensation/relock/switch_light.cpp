#include <zlg/core/compensation/switch_light.hpp>

#include "relock_light.hpp"

namespace zlg::core {

void step(const CompensationConstants& gyro, const RelockProfileConfig& config, SwitchLight& state,
          const HalfRecord& half, LightSamples light, bool counts, std::int64_t index, int halves) noexcept {
    if (!counts) {
        state.armed = true;
        return;
    }
    const bool begins = state.armed;
    state.armed = false;
    if (!begins && (state.n_samples == 0 || state.n_halves == state.sums.basis.halves)) return;
    DetuningSamples samples;
    samples.n = 0;
    if (!is_refused(gyro, half)) read_samples(gyro, config, half, light, samples);
    if (begins) {
        state.first_half = index;
        state.n_halves = 0;
        state.n_samples = samples.n;
        state.sums = LightSums{};
        // The ticks that are corrected begin with a whole one.
        if (samples.n > 0) state.sums.basis = light_basis(halves + static_cast<int>(index % 2));
    }
    if (samples.n == 0 || samples.n != state.n_samples) {
        state.n_samples = 0;
        return;
    }
    add(state.sums, state.n_halves++, std::span{samples.lambda}.first(static_cast<std::size_t>(samples.n)));
}

}  // namespace zlg::core
