#pragma once
// Noise of the substituted ticks, and what one mode switch leaves in the angle altogether: eq (19) and its omission.
//
// A gain is the sigma of what the fit gives over the sigma of one measured tick; the true angle counts as known.
//
// Two kinds of noise. White: sigma_out^2 = sigma^2 sum W_k^2. Counter: a tick is the difference of two roundings of a
// free-running count, each uniform in +-LSB/2, so ticks have the covariance LSB^2/6 on the diagonal and -LSB^2/12
// beside it; the sigma of a tick is LSB/sqrt 6 and its error triangular. Both presume roundings that are independent
// from tick to tick; at rest, without jitter of the bias, they are not.

#include <optional>
#include <span>

#include <zlg/design/substitution.hpp>

namespace zlg::design {

enum class TickNoise { white, counter };

// Gain of the sum over the gap. Errors as sum_weights.
[[nodiscard]] double sum_gain(const Substitution& substitution, TickNoise noise);

// sigma of a tick from the weight of a count, LSB/sqrt 6. lsb_arcsec >= 0.
[[nodiscard]] double counter_tick_sigma_arcsec(double lsb_arcsec);

// The sigma of the sum at this order over that at order 0, with the same fit and points (white noise).
[[nodiscard]] double sigma_ratio_to_constant(const Substitution& substitution);

// The ratio of amplitude to white noise, A T/sigma, from which the order `high` beats `low` at this frequency, in rms
// over phases, (A |H|)^2/2 + (g sigma)^2:
//
//   A T/sigma = T sqrt( 2 (g_high^2 - g_low^2) / (|H_low|^2 - |H_high|^2) )
//
// Nothing where the higher order never wins. 0 where it always does. The order of `substitution` is ignored.
[[nodiscard]] std::optional<double> crossing_ratio(Substitution substitution, int low, int high, double frequency_hz);

// 3 sigma of the gap filled with a constant from four ticks, A = noise_arcsec being 3 sigma of one tick.
//
// As printed: A sqrt(n)/2. That is the root sum square over the replaced ticks, which share one mean: the sum has
// n A/2. n >= 1, noise_arcsec >= 0, otherwise DesignError.
[[nodiscard]] double constant_noise_as_printed_arcsec(double noise_arcsec, int n);
[[nodiscard]] double constant_noise_arcsec(double noise_arcsec, int n);

// What re-lock leaves in the ticks n+1, n+2, ... [arcsec each]: directly in the angle, and through the fit, which uses
// the first of them as points. No residual given for a point counts as 0. Errors as sum_weights; all finite.
[[nodiscard]] double relock_through_fit_arcsec(const Substitution& substitution,
                                               std::span<const double> residual_arcsec);
[[nodiscard]] double relock_residual_arcsec(const Substitution& substitution, std::span<const double> residual_arcsec);

// Eq (19), sqrt(motion^2 + noise^2): all in the same sense, rms or 3 sigma; >= 0.
[[nodiscard]] double switch_error_as_printed_arcsec(double motion_arcsec, double noise_arcsec);

// Eq (19) with the residual of re-lock that it omits, |.| of relock_residual_arcsec.
[[nodiscard]] double switch_error_arcsec(double motion_arcsec, double noise_arcsec, double relock_arcsec);

}  // namespace zlg::design
