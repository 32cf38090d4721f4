#pragma once
// The terms of a gyro's noise, found from a record of its rate.
//
// Sinusoids are found as lines of the spectrum and subtracted. The smooth terms (IEEE Std 952, annex C) are fitted to
// overlapped Hadamard variances at octaves of tau, to which a ramp adds nothing, by maximum likelihood: each variance
// follows the chi-square law with the equivalent degrees of freedom that the fitted terms give it (Greenhall and Riley,
// PTTI 2003), neighbours correlate as those terms make them, and both are computed, not presumed. The ramp is the slope
// of the rate by generalised least squares under that noise. The result is read on the Allan plot as usual; the fit
// does not use its points, for neighbouring averaging times of one record share most of their noise, and a ramp could
// not be distinguished from a rate random walk in them.
//
// What a sensor does between samples, its low pass, held values or the rounding of its counter, ends at some averaging
// time, and beyond the memory of any low pass white noise differs from that without it by one coefficient only, that of
// a low pass of first order. So the shortest averaging times are left free where the terms do not hold there.
//
// A term is reported where the data refuse to do without it: of all sets of terms the one with the least
// -2 log likelihood + 6.6 for each coefficient, and each averaging time left free, is reported (a chance of 0.5 % each
// for one that is absent; a Markov term has two). Its standard error includes that of the other terms and, for few
// degrees of freedom, its own uncertainty.

#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include <zlg/deviations/series.hpp>
#include <zlg/noise/noise_terms.hpp>

namespace zlg::noise {

enum class NoiseKind {
    quantisation,
    angle_random_walk,
    bias_instability,
    rate_random_walk,
    ramp,
    markov,
    sine,
};

[[nodiscard]] std::string_view name_of(NoiseKind kind);
// "arcsec", "arcsec/sqrt(s)", ...
[[nodiscard]] std::string_view unit_of(NoiseKind kind);

struct FittedTerm {
    static constexpr double none = std::numeric_limits<double>::quiet_NaN();

    NoiseKind kind = NoiseKind::quantisation;
    bool found = false;
    double value = none;  // in the unit of the kind; of markov and sine the deviation and the amplitude. Ramp: signed
    double sigma = none;  // one standard deviation
    // Of markov the time, s; of sine the frequency, Hz; of angle random walk behind a low pass its bandwidth, Hz, -3
    // dB.
    double second = none;
    double second_sigma = none;
    double limit = none;      // where not found: 95 % of such gyros have less; none for markov and sine
    double read_at_s = none;  // the tau at which the Allan deviation of the term alone is read: see docs/noise.md
};

// One Hadamard variance of the fit.
struct FitPoint {
    std::int64_t m = 1;
    double tau_s = 0.0;
    double measured = 0.0;  // (arcsec/s)^2, without the sinusoids
    double fitted = 0.0;
    double degrees = 0.0;  // of freedom, by the fitted terms
};

struct NoiseFit {
    NoiseTerms terms;                // those found
    std::vector<FittedTerm> fitted;  // every kind once, found or not; sinusoids one each
    std::vector<FitPoint> points;
    double from_tau_s = 0.0;  // the shorter averaging times are left free: the sensor's filter or rounding rules them
    // Sum of squares of what is left, in units of its covariance, and how probable that much or more is.
    double chi2 = 0.0;
    std::int64_t dof = 0;
    double probability = 1.0;
    // Real records are more than these terms. Where chance alone does not explain what is left (probability below
    // 0.001), each variance is allowed this relative error beside chance, the least that suffices: 0, 0.02, 0.05, 0.1,
    // 0.2.
    double model_error = 0.0;
    // False where that is not enough: the gyro was moved, or has noise of another kind. The standard errors are then
    // multiplied by sqrt(chi2/dof), and limits are not given.
    bool describes = true;
};

struct NoiseFitOptions {
    bool markov = true;
    int most_sines = 3;  // 0: none are looked for
    double least_known_ratio = 0.9;
    int threads = 1;
};

// errors  SeriesError: as AngleRecord; fewer than 64 intervals.
[[nodiscard]] NoiseFit fit_noise(const deviations::Series& series, const NoiseFitOptions& options = {});

// Rates in arcsec/s over each interval, NaN where missing. Of phase one fewer than samples.
[[nodiscard]] std::vector<double> rates_arcsec_s(const deviations::Series& series);

// The same of such rates, from which the sinusoids that are found are subtracted.
[[nodiscard]] NoiseFit fit_noise_in_place(std::vector<double>& rates_arcsec_s, double rate_hz,
                                          const NoiseFitOptions& options = {});

}  // namespace zlg::noise
