#include <zlg/core/compensation/switch_light.hpp>

#include <zlg/core/common/maths.hpp>

#include "common/bounds.hpp"

namespace zlg::core {
namespace {

constexpr std::size_t min_samples = 4;

// Below it a converter may well give the same number throughout a half.
constexpr double min_noise_ratio = 1e-4;

// Of the range of a curve, to a part of 1e12.
constexpr int n_halvings = 40;

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
    return positive && moves && is_finite(mean) ? mean : not_a_number;
}

// The apparent detuning behind a true one, by halves.
double apparent(const DiscriminatorCurve& curve, double detuning_lambda) noexcept {
    if (curve.n_nodes == 0) return detuning_lambda;
    double high = curve.apparent_lambda[static_cast<std::size_t>(curve.n_nodes - 1)];
    double low = curve.apparent_lambda[0] < 0.0 ? curve.apparent_lambda[0] : -high;
    for (int k = 0; k < n_halvings; ++k) {
        const double x = 0.5 * (low + high);
        (true_detuning(curve, x).detuning_lambda > detuning_lambda ? high : low) = x;
    }
    return 0.5 * (low + high);
}

// By the control, which records 0: neither the square nor the light is usable.
bool is_refused(const CompensationConstants& gyro, const HalfRecord& half) noexcept {
    return gyro.light_noise.value() > 0.0 && half.detuning_sq_lambda2 <= 0.0;
}

// The light samples of one half-period as detunings: how many, 0 where the light cannot be used.
int read_samples(const CompensationConstants& gyro, const RelockProfileConfig& c, const HalfRecord& half,
                 LightSamples light, std::array<double, max_light_samples>& lambda) noexcept {
    const std::size_t n = light.a.size();
    const bool has_b = !light.b.empty();
    if (n < min_samples || n > static_cast<std::size_t>(max_light_samples) || (has_b && light.b.size() != n)) return 0;
    const bool may_stand_still = !(size(gyro.light_noise.value() * c.discriminator_per_lambda) > min_noise_ratio);
    const double mean_a = good_mean(light.a, may_stand_still);
    const double mean_b = has_b ? good_mean(light.b, may_stand_still) : 1.0;
    if (!(mean_a > 0.0 && mean_b > 0.0 && is_finite(mean_a + mean_b))) return 0;
    // The mean light signal of the half, by its recorded detuning: that of both beams as the control has balanced them.
    const double per_lambda = half.bias_sign * half.mode * c.discriminator_per_lambda;
    const bool is_apparent = gyro.record_curve.n_nodes > 0;
    const double seen = per_lambda * (is_apparent ? half.detuning_lambda : apparent(c.curve, half.detuning_lambda));
    // Of beam A alone the level; of both beams, which photodiodes show unequally, the weight of B.
    const double level = has_b ? mean_a / mean_b * (1.0 - seen) / (1.0 + seen) : mean_a / (1.0 + seen);
    if (!(level > 0.0)) return 0;
    bool possible = true;
    bool on_curve = false;
    for (std::size_t k = 0; k < n; ++k) {
        const double a = static_cast<double>(light.a[k]);
        const double b = has_b ? level * static_cast<double>(light.b[k]) : 0.0;
        const double x = (has_b ? (a - b) / (a + b) : a / level - 1.0) / per_lambda;
        const CurvePoint at = true_detuning(c.curve, x);
        possible &= is_within(x, -max_detuning_lambda, max_detuning_lambda);
        on_curve |= at.slope > 0.0;
        // From the largest bias on: a square of that is a deficit.
        lambda[k] = at.detuning_lambda - gyro.centre.value();
    }
    // Light that is beyond the curve throughout is of another mode.
    return possible && on_curve ? static_cast<int>(n) : 0;
}

// Of the variance of a sample's noise: by the slope of the curve that the detuning has come through, here or in the
// control.
double noise_gain(const CompensationConstants& gyro, const TrueMoments& seen) noexcept {
    if (gyro.record_curve.n_nodes != 0 || gyro.control_curve.n_nodes == 0) return square(seen.slope);
    return square(slope_behind(gyro.control_curve, seen.mean_lambda));
}

}  // namespace

void step(const CompensationConstants& gyro, const RelockProfileConfig& config, SwitchLight& state,
          const HalfRecord& half, LightSamples light, bool counts, std::int64_t index, int halves) noexcept {
    if (!counts) {
        state.armed = true;
        return;
    }
    const bool begins = state.armed;
    state.armed = false;
    if (!begins && (state.n_samples == 0 || state.n_halves == state.sums.basis.halves)) return;
    std::array<double, max_light_samples> lambda;
    const int n = is_refused(gyro, half) ? 0 : read_samples(gyro, config, half, light, lambda);
    if (begins) {
        state.first_half = index;
        state.n_halves = 0;
        state.n_samples = n;
        state.sums = LightSums{};
        // The ticks that are corrected begin with a whole one.
        if (n > 0) state.sums.basis = light_basis(halves + static_cast<int>(index % 2));
    }
    if (n == 0 || n != state.n_samples) {
        state.n_samples = 0;
        return;
    }
    add(state.sums, state.n_halves++, std::span{lambda}.first(static_cast<std::size_t>(n)));
}

TrueMoments moments_of(const CompensationConstants& gyro, const HalfRecord& half) noexcept {
    return true_moments(gyro.record_curve, half.detuning_lambda, half.detuning_sq_lambda2,
                        square(gyro.light_noise.value()));
}

RecordedSquare recorded_square(const CompensationConstants& gyro, const HalfRecord& half) noexcept {
    if (is_refused(gyro, half)) return {};
    const double noise_sq = square(gyro.light_noise.value());
    const TrueMoments seen = moments_of(gyro, half);
    const double from_centre = about(gyro.centre, seen);
    if (!(from_centre >= 0.0 && from_centre < square(max_detuning_lambda))) return {};
    // Mean of n squares (dl + e)^2: variance (4 dl^2 s^2 + 2 s^4)/n; the measured mean holds dl^2 + s^2.
    const double s2 = noise_sq * noise_gain(gyro, seen);
    const double above = from_centre - s2;
    const double sq = above > 0.0 ? above : 0.0;
    const double variance = (4.0 * sq * s2 * square(loss_at(gyro.bend, sq).slope) + 2.0 * s2 * s2) / gyro.light_samples;
    if (!is_finite(variance)) return {};
    // With q = t_e/T the trapezoid weighs the halves of a tick: of x evenly over -1/2..1/2 the mean square is 1/12, and
    // with its weight (1 + (1 - 2 q)^2)/24, which is less by the part 2 q (1 - q).
    const double edge = 1.0 - 1.0 / gyro.plateau_ratio;
    const double less = 2.0 * edge * (1.0 - edge);
    const double beyond = beyond_square(gyro, seen);
    return {
        .known = true,
        .mean_sq_lambda2 = above + beyond,
        .variance_lambda4 = variance,
        .over_trapezoid_lambda2 = less * spread_lambda2(gyro, seen) + beyond - beyond_square(gyro, seen, 1.0 - less)};
}

}  // namespace zlg::core
