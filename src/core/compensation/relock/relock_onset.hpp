#pragma once
// The onset w at which the loop begins to act, and the average of the first tick over all w.
//
// Before the onset dl is constant at its value there. From the onset on it is one cubic to the end of the first tick;
// where the onset lies in the second quarter of the tick, or at 0, it is a cubic of its own in each half. These are
// the fewest terms that leave loops that are slow, fast, oscillating or have a dead time without bias
// (docs/compensation.md).
//
// For each onset, with x the coefficients of the cubic at w = 0 (its end) and A, b their information, the later halves
// included:
//
//   x^ = A^-1 b,  cov(x^) = sigma^2 A^-1,  log-likelihood = b^T x^/(2 sigma^2) + const                   (1)
//   m_j = x^T F_j x,  estimated as (x^)^T F_j x^ - sigma^2 tr(F_j A^-1)                                     (2)
//   cov(m_j, m_k) = 4 sigma^2 (F_j x^)^T A^-1 (F_k x^)                                     (3)
//
// F_j is the form of the mean square over half j. The term of fourth order in sigma is left out of (3); for a half that
// the chain passes it is in the variance (relock_chain.hpp). The average over the onsets has the weights of (1), which
// are likelihoods at their maximum, without the factor |A|^-1/2 of a Bayesian average, the onset 0 doubled. Its covariance is,
// by the law of total covariance, the mean of (3) plus the covariance of the estimates over the onsets.

#include <cstdint>

#include <zlg/core/compensation/relock_profile_state.hpp>

namespace zlg::core {

inline constexpr std::int32_t n_onsets = 33;  // 0..T in steps of T/32

// Add the next onset to the average: index = 0 .. n_onsets - 1, in this order.
void try_onset(RelockProfileState& state, std::int32_t index) noexcept;

// The average over all onsets: the profile of the first tick, and the smoothed state after it.
void average_onsets(RelockProfileState& state) noexcept;

}  // namespace zlg::core
