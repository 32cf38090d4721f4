#pragma once
// Mean squares of the detuning after the perimeter loop is closed again, from the light samples y of all halves
// together: a cubic spline with an unknown onset.
//
// Model. In half k = 0..15 after closing, u = 0..1 the time within it and z = (value, slope, half the second derivative) at its start,
//
//   dl(u) = z_0 + z_1 u + z_2 u^2 + a u^3,   y = dl + white noise of variance sigma^2                   (1)
//
// z is continuous and a is free: knots T/2, as a linear state-space model (relock_chain.hpp). At an unknown onset
// w = 0, T/32, .. T the loop begins to act; before it dl is constant (relock_onset.hpp). Wanted are m_k = integral of
// dl^2 over half k and their covariance:
//
//   backward  information filter from half 15 to half 2                    (relock_chain.hpp, (2)-(4))
//   onset     average of the first tick over all w, weights exp(-residuals/(2 sigma^2)), and its link to half 2
//   forward   fixed-interval smoothing from half 2 to half 15: m_k and its covariance with all earlier ones
//
// Method: Anderson and Moore, Optimal Filtering, 1979, ch. 6-7. Figures: docs/compensation.md.

#include <zlg/core/compensation/compensation_constants.hpp>
#include <zlg/core/compensation/relock_profile_config.hpp>
#include <zlg/core/compensation/relock_profile_state.hpp>
#include <zlg/core/records.hpp>

namespace zlg::core {

// A gap begins: the profile of the last one is discarded, and the next half added is the first one after this gap.
void enter_gap(RelockProfileState& state) noexcept;

// Add one half with the loop closed, in order of time; those beyond the first 16 are ignored.
//
// light    both beams; one beam alone needs the half's recorded mean and has sqrt(2) times the noise; 4..64 samples, as
//          many in each half. Where there is none, or where it is damaged (not finite, dark, stuck, not smooth), the
//          profile comes from the recorded mean squares with the 16th half; without these it is not known.
// cost     the onsets come with the 5th and the 7th half, the smoothing with the 16th.
void step(const CompensationConstants& gyro, const RelockProfileConfig& config, RelockProfileState& state,
          const HalfRecord& half, LightSamples light) noexcept;

}  // namespace zlg::core
