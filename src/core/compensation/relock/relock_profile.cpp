#include <zlg/core/compensation/relock_profile.hpp>

#include <memory>

#include <zlg/core/common/maths.hpp>

#include "relock_chain.hpp"
#include "relock_light.hpp"
#include "relock_moment.hpp"

namespace zlg::core {
namespace {

// The first halves, which decide on the moment: later ones say no more of the first tick.
constexpr std::int32_t halves_for_moments = 5;

// Moments that are tried with the last of them; the others, each of which costs more, in the next half.
constexpr std::int32_t first_moments = 18;

// Beyond so many standard deviations a sum of squared residuals is not noise. A false alarm costs little.
constexpr double max_deviation = 2.0;

// Residuals above so many times the noise from sample to sample are not of noise either.
constexpr double max_over_rough = 2.0;

double square(double x) noexcept { return x * x; }

double weighted_sum_sq(const RelockProfileState& s, std::size_t from, std::size_t to) noexcept {
    double sum = 0.0;
    for (std::size_t k = from; k < to; ++k) sum += s.halves[k].weight * s.halves[k].sum_sq;
    return sum;
}

// By how many of its standard deviations a sum of squared residuals of the given noise exceeds what it should be.
double deviation(double residual_sq, double freedom, double noise_sq) noexcept {
    return (residual_sq / noise_sq - freedom) / square_root(2.0 * freedom);
}

void use_records(RelockProfileState& s) noexcept {
    s.n_samples = 0;
    s.profile.known = s.columns_known && s.n_halves == profile_halves;
}

// The noise from sample to sample in the halves after the first tick, whatever their course: mean square, and one standard
// deviation of it over the value for white noise.
struct Roughness {
    double mean_sq = 0.0;
    double scatter = 0.0;
};

Roughness roughness(const RelockProfileState& s) noexcept {
    double sum = 0.0;
    for (std::size_t k = 2; k < halves_for_moments; ++k) sum += s.halves[k].weight * s.halves[k].rough_sq;
    const double n = (halves_for_moments - 2) * (s.n_samples - 2.0);
    // Second differences of white noise are correlated by -4/6 and 1/6.
    return {sum / n, square_root(2.0 * (1.0 + 2.0 * (16.0 + 1.0) / 36.0) / n)};
}

// The noise of the samples: as configured, or what their residuals are, where it is another. False: these are not noise.
bool find_noise(RelockProfileState& s, double residual_sq) noexcept {
    const double freedom = (halves_for_moments - 2) * (s.n_samples - 1.0) - 3.0;
    const double configured = s.noise_sq_lambda2;
    const double off = deviation(residual_sq, freedom, configured);
    if (!(off < max_deviation && off > -max_deviation)) {
        const Roughness rough = roughness(s);
        const double found = residual_sq / freedom;
        const bool as_configured = rough.mean_sq < configured * (1.0 + 3.0 * rough.scatter) &&
                                   rough.mean_sq > configured * (1.0 - 3.0 * rough.scatter);
        if (off > max_deviation && (as_configured || found > max_over_rough * rough.mean_sq)) return false;
        s.noise_sq_lambda2 = found;
    }
    const double least = 1e-12 * square(s.scale_lambda);
    if (!(s.noise_sq_lambda2 > least)) s.noise_sq_lambda2 = least;
    return true;
}

// Does the best of the moments explain the first halves?
bool is_explained(const RelockProfileState& s) noexcept {
    const double freedom = halves_for_moments * s.n_samples - (halves_for_moments + 2.0);
    const double residual_sq = weighted_sum_sq(s, 0, halves_for_moments) - s.information.fitted_sq -
                               2.0 * s.noise_sq_lambda2 * s.mixture.log_best;
    return deviation(residual_sq, freedom, s.noise_sq_lambda2) < max_deviation;
}

void try_moments(RelockProfileState& s, std::int32_t from, std::int32_t to) noexcept {
    for (std::int32_t i = from; i < to; ++i) try_moment(s, i);
}

// The halves after the first tick, backwards, and the first moments. False: no such course.
bool begin_moments(RelockProfileState& s) noexcept {
    s.scale_lambda = square_root(s.halves[0].sum_sq / s.n_samples + s.noise_sq_lambda2 + 1e-24);
    s.information = {};
    for (std::size_t k = halves_for_moments; k-- > 2;)
        (void)absorb(s.halves[k], s.powers, cubic_ridge(s), s.information);
    const double residual_sq =
        weighted_sum_sq(s, 2, halves_for_moments) - s.information.fitted_sq - explained(s.information);
    if (!find_noise(s, residual_sq)) return false;
    s.mixture = {};
    try_moments(s, 0, first_moments);
    return true;
}

// The other moments.
bool end_moments(RelockProfileState& s) noexcept {
    try_moments(s, first_moments, relock_moments);
    return is_explained(s);
}

// The chain forwards: each half's mean square and its covariance with all before it.
void pass_halves(RelockProfileState& s) noexcept {
    auto& covariance = s.profile.covariance_lambda4;
    for (std::size_t k = 2; k < profile_halves; ++k) {
        const PassedHalf passed = pass(s.gains[k], s.noise_sq_lambda2, s.link);
        s.profile.mean_sq_lambda2[k] = passed.mean_sq_lambda2;
        covariance[k][k] = passed.variance_lambda4;
        for (std::size_t l = 0; l < k; ++l) {
            covariance[k][l] = covariance[l][k] = dot(passed.slope, s.with_half[l]);
            s.with_half[l] = onward(s.gains[k], s.with_half[l]);
        }
        s.with_half[k] = passed.with_next;
    }
}

// The later halves backwards, and forwards from the mean of the moments.
void smooth(RelockProfileState& s) noexcept {
    s.information = {};
    for (std::size_t k = profile_halves; k-- > 2;)
        s.gains[k] = absorb(s.halves[k], s.powers, cubic_ridge(s), s.information);
    average_moments(s);
    pass_halves(s);
    s.profile.known = true;
}

// Sums of u^p over the samples of a half.
std::array<double, 7> sums_of_powers(std::int32_t n) noexcept {
    std::array<double, 7> sums{};
    for (std::int32_t i = 0; i < n; ++i) {
        double power = 1.0;
        for (double& sum : sums) {
            sum += power;
            power *= (i + 0.5) / n;
        }
    }
    return sums;
}

void take_samples(const DetuningSamples& samples, RelockProfileState& s) noexcept {
    const auto k = static_cast<std::size_t>(s.n_halves);
    if (k == 0) s.powers = sums_of_powers(samples.n);
    RelockHalf half{.weight = samples.weight};
    const double step = 1.0 / samples.n;
    double before = samples.lambda[1];
    double rise = before - samples.lambda[0];
    for (std::size_t i = 2; i < static_cast<std::size_t>(samples.n); ++i) {
        const double next_rise = samples.lambda[i] - before;
        half.rough_sq += square(next_rise - rise) / 6.0;
        rise = next_rise;
        before = samples.lambda[i];
    }
    for (std::int32_t i = 0; i < samples.n; ++i) {
        const double u = (i + 0.5) * step;
        const double y = samples.lambda[static_cast<std::size_t>(i)];
        const double yu = y * u;
        half.sum_sq += y * y;
        half.moments[0] += y;
        half.moments[1] += yu;
        half.moments[2] += yu * u;
        half.moments[3] += yu * u * u;
    }
    s.halves[k] = half;
    if (k < 2)
        for (std::size_t i = 0; i < static_cast<std::size_t>(samples.n); ++i)
            s.first_tick_lambda[k][i] = samples.lambda[i];
}

void take_record(const RecordedSquare& recorded, RelockProfileState& s) noexcept {
    const auto k = static_cast<std::size_t>(s.n_halves);
    s.columns_known = s.columns_known && recorded.known;
    s.profile.mean_sq_lambda2[k] = recorded.mean_sq_lambda2;
    s.profile.covariance_lambda4[k][k] = recorded.variance_lambda4;
}

void take_light(const DetuningSamples& samples, RelockProfileState& s) noexcept {
    if (s.n_halves == 0) s.n_samples = samples.n;
    if (samples.n == 0 || samples.n != s.n_samples)
        use_records(s);
    else
        take_samples(samples, s);
}

}  // namespace

RelockProfileFault check(const RelockProfileConfig& c) noexcept {
    const double k = c.discriminator_per_lambda;
    if (!((k >= 1e-6 && k <= 1e6) || (k <= -1e-6 && k >= -1e6))) return RelockProfileFault::discriminator;
    if (check(c.curve) != CurveFault::none || check(c.record_curve) != CurveFault::none)
        return RelockProfileFault::curve;
    if (!(c.centre >= -1.0 * max_centre && c.centre <= max_centre)) return RelockProfileFault::centre;
    if (!(c.light_noise.value() >= 0.0 && c.light_noise.value() <= 1e3)) return RelockProfileFault::light_noise;
    if (!(c.light_samples >= 1)) return RelockProfileFault::light_samples;
    return RelockProfileFault::none;
}

void enter_gap(RelockProfileState& state) noexcept {
    if (state.armed && state.n_halves == 0) return;  // nothing was taken since
    std::construct_at(&state);
    state.armed = true;
}

void take(const RelockProfileConfig& config, RelockProfileState& state, const HalfRecord& half,
          LightSamples light) noexcept {
    if (!state.armed || state.n_halves == profile_halves) return;
    if (state.n_halves == 0) {
        state.columns_known = true;
        state.noise_sq_lambda2 = square(config.light_noise.value());
    }
    const RecordedSquare recorded = recorded_square(config, half);
    take_record(recorded, state);
    if (state.n_halves == 0 || state.n_samples > 0) {
        DetuningSamples samples;
        if (!recorded.refused) read_samples(config, half, light, samples);
        take_light(samples, state);
    }
    ++state.n_halves;
    if (state.n_samples > 0 && state.n_halves == halves_for_moments && !begin_moments(state)) use_records(state);
    if (state.n_samples > 0 && state.n_halves == halves_for_moments + 1 && !end_moments(state)) use_records(state);
    if (state.n_halves < profile_halves) return;
    if (state.n_samples > 0)
        smooth(state);
    else
        use_records(state);
}

}  // namespace zlg::core
