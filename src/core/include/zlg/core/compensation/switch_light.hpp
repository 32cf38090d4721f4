#pragma once
// The light of a switch: the samples of the halves from the first one in which both beams are lit, or the loop is closed, gathered
// for the fit of the detuning (light_spline.hpp).

#include <cstdint>

#include <zlg/core/compensation/compensation_constants.hpp>
#include <zlg/core/compensation/light_spline.hpp>
#include <zlg/core/compensation/relock_profile_config.hpp>
#include <zlg/core/records.hpp>

namespace zlg::core {

struct SwitchLight {
    bool armed = false;            // the next half that counts is the first one
    std::int64_t first_half = -1;  // its index; -1: of none
    int n_halves = 0;
    int n_samples = 0;  // a half
    LightSums sums{};

    friend bool operator==(const SwitchLight&, const SwitchLight&) = default;
};

// Add one half, in order of time.
//
// counts  its light is that of the new mode: measured, or lit in an open loop.
// index   of the half.
// halves  that are gathered.
void step(const CompensationConstants& gyro, const RelockProfileConfig& config, SwitchLight& state,
          const HalfRecord& half, LightSamples light, bool counts, std::int64_t index, int halves) noexcept;

// All halves are there, and every one could be read.
[[nodiscard]] constexpr bool is_complete(const SwitchLight& light) noexcept {
    return light.n_samples > 0 && light.n_halves == light.sums.basis.halves;
}

}  // namespace zlg::core
