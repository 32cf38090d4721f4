#include <zlg/noise/noise_terms.hpp>

#include <cmath>
#include <numbers>

namespace zlg::noise {
namespace {

using std::numbers::pi;

double squared(double x) { return x * x; }

// t/T + exp(-t/T) - 1, without loss where t is short.
double relaxation(double ratio) {
    return ratio < 1e-2 ? ratio * ratio * (0.5 - ratio * (1.0 / 6.0 - ratio / 24.0)) : ratio + std::expm1(-ratio);
}

// n-th differences of the phase of a sine at distance tau, mean square: A^2/2 (2 sin(pi f tau))^(2n)/(2 pi f)^2.
double sine_differences(const SineTerm& sine, double tau_s, int order) {
    const double w = 2.0 * pi * sine.frequency_hz;
    return 0.5 * squared(sine.amplitude_arcsec_s / w) * std::pow(squared(2.0 * std::sin(0.5 * w * tau_s)), order);
}

}  // namespace

double angle_covariance(const NoiseTerms& terms, double t_s) {
    const double t = std::abs(t_s);
    const double filter_s = terms.filter_time_s;
    double sum = -0.5 * squared(terms.angle_random_walk_arcsec_sqrt_s) *
                 (filter_s > 0.0 ? filter_s * relaxation(t / filter_s) : t);
    if (t > 0.0) sum += squared(terms.bias_instability_arcsec_s) / (2.0 * pi) * t * t * std::log(t);
    sum += squared(terms.rate_random_walk_arcsec_s_sqrt_s) * t * t * t / 12.0;
    for (const MarkovNoise& m : terms.markov)
        sum -= squared(m.deviation_arcsec_s * m.time_s) * relaxation(t / m.time_s);
    return sum;
}

double allan_variance(const NoiseTerms& terms, double tau_s) {
    const double r1 = angle_covariance(terms, tau_s), r2 = angle_covariance(terms, 2.0 * tau_s);
    double differences = 2.0 * r2 - 8.0 * r1 + 6.0 * squared(terms.quantisation_arcsec);
    for (const SineTerm& sine : terms.sines) differences += sine_differences(sine, tau_s, 2);
    return 0.5 * differences / squared(tau_s) + 0.5 * squared(terms.ramp_arcsec_s2 * tau_s);
}

double hadamard_variance(const NoiseTerms& terms, double tau_s) {
    const double r1 = angle_covariance(terms, tau_s), r2 = angle_covariance(terms, 2.0 * tau_s),
                 r3 = angle_covariance(terms, 3.0 * tau_s);
    double differences = -30.0 * r1 + 12.0 * r2 - 2.0 * r3 + 20.0 * squared(terms.quantisation_arcsec);
    for (const SineTerm& sine : terms.sines) differences += sine_differences(sine, tau_s, 3);
    return differences / (6.0 * squared(tau_s));
}

double rate_spectrum(const NoiseTerms& terms, double frequency_hz, double rate_hz) {
    const double w = 2.0 * pi * frequency_hz;
    double sum = squared(terms.angle_random_walk_arcsec_sqrt_s) / (1.0 + squared(w * terms.filter_time_s)) +
                 squared(terms.bias_instability_arcsec_s) / w + squared(terms.rate_random_walk_arcsec_s_sqrt_s / w) +
                 4.0 * rate_hz * squared(terms.quantisation_arcsec * std::sin(pi * frequency_hz / rate_hz));
    for (const MarkovNoise& m : terms.markov)
        sum += 2.0 * squared(m.deviation_arcsec_s) * m.time_s / (1.0 + squared(w * m.time_s));
    return sum;
}

}  // namespace zlg::noise
