#include "motion.hpp"

#include <cmath>
#include <complex>
#include <numbers>

#include <zlg/core/common/maths.hpp>

namespace zlg::trials {
namespace {

namespace maths = core::maths;
using std::numbers::pi;

// A shock rings as the imaginary part of exp(pole t).
std::complex<double> pole(const Shocks& s) { return {-1.0 / s.decay_s, 2.0 * pi * s.ring_hz}; }

std::complex<double> exponential(std::complex<double> z) {
    const auto [sine, cosine] = maths::sincos(z.imag());
    return maths::exp(z.real()) * std::complex<double>{cosine, sine};
}

// Not by the run-time library of the compiler, whose products and quotients need not be the same everywhere.
std::complex<double> product(std::complex<double> a, std::complex<double> b) {
    return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}
std::complex<double> quotient(std::complex<double> a, std::complex<double> b) {
    return product(a, std::conj(b)) / std::norm(b);
}

// Angle from t0 to t1 by one shock at time 0.
double integral_of_shock(const Shocks& s, double t0, double t1) {
    if (t1 <= 0.0) return 0.0;
    const std::complex<double> p = pole(s);
    return s.rate_arcsec_s * std::imag(quotient(exponential(p * t1) - exponential(p * std::max(0.0, t0)), p));
}

// Campbell's theorem: a Poisson process of shocks at rate r with responses g has the covariance r int g(t) g(t + lag)
// dt (Papoulis, Probability, Random Variables and Stochastic Processes, ch. 10).
double shock_covariance(const Shocks& s, double half_s, double lag_s) {
    const double step = half_s / 16.0;
    const double last = 12.0 * s.decay_s;
    double sum = 0.0;
    for (double t = 0.5 * step - half_s; t < last; t += step)
        sum += integral_of_shock(s, t, t + half_s) * integral_of_shock(s, t + lag_s, t + lag_s + half_s);
    return s.per_s * sum * step;
}

// Amplitude of the increment of a half by a tone of unit rate.
double tone_gain(double w, double half_s) {
    return w * half_s < 1e-9 ? half_s : 2.0 / w * maths::sin(0.5 * w * half_s);
}

// Covariance of the increments of two halves, lag_s apart, by a tone whose rate has a mean square of 1.
double tone_covariance(double frequency_hz, double half_s, double lag_s) {
    const double w = 2.0 * pi * frequency_hz;
    const double gain = tone_gain(w, half_s);
    return gain * gain * maths::cos(w * lag_s);
}

double band_covariance(const Band& band, double half_s, double lag_s) {
    constexpr int pieces = 2000;
    double sum = 0.0;
    for (int i = 0; i < pieces; ++i)
        sum += tone_covariance(band.low_hz + (band.high_hz - band.low_hz) * (i + 0.5) / pieces, half_s, lag_s);
    return band.rms_arcsec_s * band.rms_arcsec_s * sum / pieces;
}

}  // namespace

SyntheticMotion::SyntheticMotion(const MotionLaw& law, double half_s, const chance::Draw& draw)
    : draw_{draw}, half_s_{half_s}, constant_arcsec_{0.0}, shocks_{law.shocks} {
    const double spread = law.rate_spread_arcsec_s * (2.0 * draw_.uniform() - 1.0);
    constant_arcsec_ = (law.rate_arcsec_s + spread) * half_s;
    for (const Tone& tone : law.tones) add_tone(tone.frequency_hz, tone.amplitude_arcsec_s, 2.0 * pi * draw_.uniform());
    for (const Band& band : law.bands) add_band(band);
    if (shocks_.per_s > 0.0) next_shock_s_ = draw_.exponential() / shocks_.per_s;
}

void SyntheticMotion::add_tone(double frequency_hz, double amplitude_arcsec_s, double phase) {
    const double w = 2.0 * pi * frequency_hz;
    const double gain = amplitude_arcsec_s * tone_gain(w, half_s_);
    re_.push_back(gain * maths::cos(phase));
    im_.push_back(gain * maths::sin(phase));
    turn_re_.push_back(maths::cos(w * half_s_));
    turn_im_.push_back(maths::sin(w * half_s_));
}

// One tone in each of equal cells, at a random place in it: the period of the whole is longer than any run. Normal
// quadratures make the sum Gaussian at every moment.
void SyntheticMotion::add_band(const Band& band) {
    const double cell = (band.high_hz - band.low_hz) / tones_per_band;
    for (int i = 0; i < tones_per_band; ++i) {
        const double frequency = band.low_hz + cell * (i + draw_.uniform());
        const double a = draw_.normal();
        const double b = draw_.normal();
        add_tone(frequency, band.rms_arcsec_s / std::sqrt(double{tones_per_band}) * maths::hypot(a, b),
                 maths::atan2(b, a));
    }
}

double SyntheticMotion::advance_tones() {
    double sum = 0.0;
    for (std::size_t i = 0; i < re_.size(); ++i) {
        const double re = re_[i] * turn_re_[i] - im_[i] * turn_im_[i];
        im_[i] = re_[i] * turn_im_[i] + im_[i] * turn_re_[i];
        re_[i] = re;
        sum += im_[i];
    }
    return sum;
}

double SyntheticMotion::advance_shocks() {
    if (!(shocks_.per_s > 0.0)) return 0.0;
    const std::complex<double> p = pole(shocks_);
    const std::complex<double> turn = exponential(p * half_s_);
    std::complex<double> ring{ring_[0], ring_[1]};
    double sum = std::imag(quotient(product(ring, turn - 1.0), p));
    ring = product(ring, turn);
    while (next_shock_s_ < half_s_) {
        const double left = half_s_ - next_shock_s_;
        const double sign = draw_.sign();
        sum += sign * integral_of_shock(shocks_, 0.0, left);
        ring += sign * shocks_.rate_arcsec_s * exponential(p * left);
        next_shock_s_ += draw_.exponential() / shocks_.per_s;
    }
    next_shock_s_ -= half_s_;
    ring_ = {ring.real(), ring.imag()};
    return sum;
}

double SyntheticMotion::advance() { return constant_arcsec_ + advance_tones() + advance_shocks(); }

std::vector<double> increment_covariance(const MotionLaw& law, double half_s, std::size_t n) {
    std::vector<double> covariance(n, 0.0);
    for (std::size_t k = 0; k < n; ++k) {
        const double lag = static_cast<double>(k) * half_s;
        for (const Tone& tone : law.tones)
            covariance[k] += 0.5 * tone.amplitude_arcsec_s * tone.amplitude_arcsec_s *
                             tone_covariance(tone.frequency_hz, half_s, lag);
        for (const Band& band : law.bands) covariance[k] += band_covariance(band, half_s, lag);
        if (law.shocks.per_s > 0.0) covariance[k] += shock_covariance(law.shocks, half_s, lag);
    }
    return covariance;
}

}  // namespace zlg::trials
