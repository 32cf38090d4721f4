#pragma once
// The terms of a gyro's noise, in the convention of IEEE Std 952 and 647, and what each adds to the variances.
//
//   term                     spectrum of the rate, two-sided         Allan variance at tau
//   quantisation        Q    (2 pi f)^2 Q^2 tau_0                    3 Q^2/tau^2
//   angle random walk   N    N^2                                     N^2/tau
//   bias instability    B    B^2/(2 pi f)                            2 ln2/pi B^2
//   rate random walk    K    K^2/(2 pi f)^2                          K^2 tau/3
//   ramp                R    -                                       R^2 tau^2/2
//   Markov            s, T   2 s^2 T/(1 + (2 pi f T)^2)              s^2 (T/tau)^2 (2 tau/T - 3 + 4 e^(-tau/T) - e^(-2
//   tau/T)) sinusoid          A, f   a line                                  A^2 sin^4(pi f tau)/(pi f tau)^2
//
// 1 arcsec/s = 1 deg/h. A standard deviation s of the Markov term is q_c sqrt(T/2), q_c its driving noise.

#include <vector>

namespace zlg::noise {

struct MarkovNoise {
    double deviation_arcsec_s = 0.0;
    double time_s = 1.0;
};

struct SineTerm {
    double amplitude_arcsec_s = 0.0;
    double frequency_hz = 1.0;
};

// 0: the term is absent.
struct NoiseTerms {
    double quantisation_arcsec = 0.0;  // standard deviation of the error of one angle
    double angle_random_walk_arcsec_sqrt_s = 0.0;
    // Of the low pass of first order behind which it is seen: N^2/(1 + (2 pi f T)^2), the Markov term of N = s
    // sqrt(2T). At averaging times far longer than the memory of any filter that filter is one of first order.
    double filter_time_s = 0.0;
    double bias_instability_arcsec_s = 0.0;
    double rate_random_walk_arcsec_s_sqrt_s = 0.0;
    double ramp_arcsec_s2 = 0.0;
    std::vector<MarkovNoise> markov;
    std::vector<SineTerm> sines;
};

// (arcsec/s)^2; tau_s > 0.
[[nodiscard]] double allan_variance(const NoiseTerms& terms, double tau_s);

// Of third differences, so without ramp; white noise gives N^2/tau too.
[[nodiscard]] double hadamard_variance(const NoiseTerms& terms, double tau_s);

// Two-sided spectrum of the rate, (arcsec/s)^2/Hz, at 0 < f <= rate/2, without the sinusoids. Quantisation as of
// samples of that rate: 4 Q^2 sin^2(pi f/rate) rate.
[[nodiscard]] double rate_spectrum(const NoiseTerms& terms, double frequency_hz, double rate_hz);

// Generalised covariance of the angle at a distance t >= 0, but for quantisation: E of the product of two differences
// of the angle follows from it, for differences that cancel constants (and straight lines and parabolas where there are
// bias instability or rate random walk). arcsec^2
[[nodiscard]] double angle_covariance(const NoiseTerms& terms, double t_s);

}  // namespace zlg::noise
