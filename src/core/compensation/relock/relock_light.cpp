#include "relock_light.hpp"

#include <zlg/core/common/maths.hpp>

#include "common/bounds.hpp"

namespace zlg::core {
namespace {

constexpr std::size_t min_samples = 4;

// Below it a converter may well give the same number throughout a half.
constexpr double min_noise_ratio = 1e-4;

// Mean over a half, of the curve: where it is flat the light is of another mode.
constexpr double min_slope_sq = 1e-6;

constexpr int max_newton_steps = 12;

constexpr double not_good = __builtin_nan("");

// Mean of a beam; NaN where a sample is not finite or not positive, or where all are the same although they must not
// be.
double good_mean(std::span<const float> samples, bool may_stand_still) noexcept {
    bool positive = true;
    bool moves = may_stand_still;
    double sum = 0.0;
    for (const float sample : samples) {
        positive &= sample > 0.0f;
        moves |= sample != samples.front();
        sum += static_cast<double>(sample);
    }
    const double mean = sum / static_cast<double>(samples.size());
    return positive && moves && is_finite(mean) ? mean : not_good;
}

// The apparent detuning behind a true one, by Newton's method kept within what is known of the root.
double apparent(const DiscriminatorCurve& curve, double detuning_lambda) noexcept {
    if (curve.n_nodes == 0) return detuning_lambda;
    double high = curve.apparent_lambda[static_cast<std::size_t>(curve.n_nodes - 1)];
    double low = curve.apparent_lambda[0] < 0.0 ? curve.apparent_lambda[0] : -high;
    double x = 0.0;
    for (int k = 0; k < max_newton_steps; ++k) {
        const CurvePoint at = true_detuning(curve, x);
        const double above = at.detuning_lambda - detuning_lambda;
        (above > 0.0 ? high : low) = x;
        const double next = x - above / at.slope;
        x = next > low && next < high ? next : 0.5 * (low + high);
    }
    return x;
}

// The light of beam A at zero detuning; not positive where it cannot be determined.
double level_of_a(const CompensationConstants& gyro, const RelockProfileConfig& c, const HalfRecord& half, int sign,
                  double mean_a) noexcept {
    const bool is_apparent = gyro.record_curve.n_nodes > 0;
    const double x = is_apparent ? half.detuning_lambda : apparent(c.curve, half.detuning_lambda);
    return mean_a / (1.0 + sign * c.discriminator_per_lambda * x);
}

// All samples of a signal; `noise_factor` is the variance of one over that of both beams together.
template <class Signal>
void by_slope(const RelockProfileConfig& c, int sign, std::size_t n, double noise_factor, const Signal& signal,
              DetuningSamples& out) noexcept {
    out.weight = 1.0 / noise_factor;
    const double lambda_per_signal = sign / c.discriminator_per_lambda;
    bool possible = true;
    for (std::size_t k = 0; k < n; ++k) {
        const double x = lambda_per_signal * signal(k);
        possible &= x < max_detuning_lambda && x > -max_detuning_lambda;
        out.lambda[k] = x;
    }
    out.n = possible ? static_cast<std::int32_t>(n) : 0;
}

// From the largest bias on: a square of that is a deficit.
void about_centre(double centre_lambda, DetuningSamples& samples) noexcept {
    if (centre_lambda == 0.0) return;
    for (std::int32_t k = 0; k < samples.n; ++k) samples.lambda[static_cast<std::size_t>(k)] -= centre_lambda;
}

// The same through the curve, whose slope scales the noise.
void through_curve(const DiscriminatorCurve& curve, DetuningSamples& samples) noexcept {
    if (curve.n_nodes == 0) return;
    double slope_sq = 0.0;
    for (std::int32_t k = 0; k < samples.n; ++k) {
        double& x = samples.lambda[static_cast<std::size_t>(k)];
        const CurvePoint at = true_detuning(curve, x);
        x = at.detuning_lambda;
        slope_sq += square(at.slope);
    }
    const bool slopes = slope_sq > min_slope_sq * samples.n;
    samples.weight *= samples.n / slope_sq;
    if (!slopes) samples.n = 0;
}

}  // namespace

void read_samples(const CompensationConstants& gyro, const RelockProfileConfig& c, const HalfRecord& half,
                  LightSamples light, DetuningSamples& out) noexcept {
    out.n = 0;
    const std::size_t n = light.a.size();
    if (n < min_samples || n > static_cast<std::size_t>(max_light_samples)) return;
    if (!light.b.empty() && light.b.size() != n) return;
    const double noise_ratio = light_noise_lambda(gyro) * c.discriminator_per_lambda;
    const bool may_stand_still = !(noise_ratio > min_noise_ratio || noise_ratio < -min_noise_ratio);
    const int sign = half.bias_sign * half.mode;
    const double mean_a = good_mean(light.a, may_stand_still);
    if (light.b.empty()) {
        const double level = level_of_a(gyro, c, half, sign, mean_a);
        if (!(level > 0.0 && is_finite(level))) return;
        const auto signal = [light, level](std::size_t k) { return static_cast<double>(light.a[k]) / level - 1.0; };
        by_slope(c, sign, n, 2.0, signal, out);
    } else {
        if (!is_finite(mean_a + good_mean(light.b, may_stand_still))) return;
        const auto signal = [light](std::size_t k) {
            const double x = static_cast<double>(light.a[k]);
            const double y = static_cast<double>(light.b[k]);
            return (x - y) / (x + y);
        };
        by_slope(c, sign, n, 1.0, signal, out);
    }
    through_curve(c.curve, out);
    about_centre(gyro.centre.value(), out);
}

double noise_gain(const CompensationConstants& gyro, const TrueMoments& seen) noexcept {
    if (gyro.record_curve.n_nodes != 0 || gyro.control_curve.n_nodes == 0) return square(seen.slope);
    return square(slope_behind(gyro.control_curve, seen.mean_lambda));
}

RecordedSquare recorded_square(const CompensationConstants& gyro, const HalfRecord& half) noexcept {
    const double noise_sq = square(light_noise_lambda(gyro));
    const bool is_refused = noise_sq > 0.0 && half.detuning_sq_lambda2 <= 0.0;
    const TrueMoments seen = true_moments(gyro.record_curve, half.detuning_lambda, half.detuning_sq_lambda2, noise_sq);
    const double from_centre = about(gyro.centre, seen);
    if (!(from_centre >= 0.0 && from_centre < square(max_detuning_lambda))) return {};
    const double s2 = noise_sq * noise_gain(gyro, seen);
    const double above = from_centre - s2;
    const double variance = (4.0 * (above > 0.0 ? above : 0.0) * s2 + 2.0 * s2 * s2) / gyro.light_samples;
    if (is_refused || !is_finite(variance)) return {.refused = is_refused};
    return {.known = true, .mean_sq_lambda2 = above, .variance_lambda4 = variance};
}

}  // namespace zlg::core
