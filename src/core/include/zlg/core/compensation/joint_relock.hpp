#pragma once
// The false angle of each half-tick after a gap, by the profile of the detuning.
//
//   y' = y + s D,  D = chi f0 K (T/2) m      s: bias_sign * mode of the half;  K: angle per count;  m = <dl^2>   (1)
//
// y: half-tick as read, y': corrected, m and S: mean squares and their covariance (relock_profile.hpp). The errors of
// the profile alternate with s like the false angle itself: covariance s_k s_l (chi f0 K T/2)^2 S_kl. The estimate of
// the gap weighs the counts of the same half-ticks against them (optimal_bridge.hpp).

#include <array>
#include <cstdint>

#include <zlg/core/compensation/compensation_constants.hpp>
#include <zlg/core/compensation/relock_profile.hpp>
#include <zlg/core/records.hpp>

namespace zlg::core {

struct JointRelock {
    std::int64_t first_tick = -1;  // the first one after the gap; -1: of none
    bool known = false;
    std::array<double, profile_halves> correction_arcsec{};  // to be added to each half-tick
    std::array<std::array<double, profile_halves>, profile_halves> covariance_arcsec2{};

    friend bool operator==(const JointRelock&, const JointRelock&) = default;
};

struct JointRelockState {
    RelockProfileState profile{};
    std::int64_t first_tick = -1;  // after the gap
    int sign = 1;                  // in its first half
    bool delivered = true;         // no result is pending for the bridge

    friend bool operator==(const JointRelockState&, const JointRelockState&) = default;
};

// Add one half, in order of time.
//
// measured  its tick is measured, as far as this half shows.
// tick      of the half.
void step(const CompensationConstants& gyro, const RelockProfileConfig& config, JointRelockState& state,
          const HalfRecord& half, LightSamples light, bool measured, std::int64_t tick) noexcept;

// The profile is known, given up, or broken off by a gap, and this result is pending.
[[nodiscard]] bool is_due(const JointRelockState& state) noexcept;

// Deliver the pending result. temperature: NaN where not measured. Of a profile that is given up the numbers in `out`
// stay as they are.
void deliver(const CompensationConstants& gyro, JointRelockState& state, Celsius temperature,
             JointRelock& out) noexcept;

}  // namespace zlg::core
