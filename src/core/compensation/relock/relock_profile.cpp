#include <zlg/core/compensation/relock_profile.hpp>

#include <memory>

#include <zlg/core/common/maths.hpp>

#include "common/bounds.hpp"
#include "relock_chain.hpp"
#include "relock_light.hpp"
#include "relock_onset.hpp"

namespace zlg::core {
namespace {

// Halves that decide on the onset: later ones hold no more information on the first tick.
constexpr std::int32_t onset_halves = 5;

// Onsets that are tried with the last of these halves; the others, each of which costs more, two halves later.
constexpr std::int32_t onsets_in_first_half = 18;

// Test of the model: standard deviations beyond which a sum of squared residuals is not noise. One in twenty by chance,
// which costs little: the recorded mean squares are used instead.
constexpr double max_deviation = 2.0;

// Residuals above this multiple of the noise from sample to sample are not noise either. Set by hand.
constexpr double max_over_rough = 2.0;

double weighted_sum_sq(const RelockProfileState& s, std::size_t from, std::size_t to) noexcept {
    double sum = 0.0;
    for (std::size_t k = from; k < to; ++k) sum += s.halves[k].weight * s.halves[k].sum_sq;
    return sum;
}

// Excess of a sum of squared residuals over its expectation, in its standard deviations: chi-square of the given
// degrees of freedom as a normal variable.
double deviation(double residual_sq, double freedom, double noise_sq) noexcept {
    return (residual_sq / noise_sq - freedom) / square_root(2.0 * freedom);
}

// No profile from the light: use the recorded mean squares, if there are any.
void use_records(RelockProfileState& s) noexcept {
    s.n_samples = 0;
    s.profile.known = s.columns_known && s.n_halves == profile_halves;
}

// Noise from sample to sample in the halves after the first tick, from second differences: mean square, and its
// relative standard deviation for white noise.
struct Roughness {
    double mean_sq = 0.0;
    double scatter = 0.0;
};

Roughness roughness(const RelockProfileState& s) noexcept {
    double sum = 0.0;
    for (std::size_t k = 2; k < onset_halves; ++k) sum += s.halves[k].weight * s.halves[k].rough_sq;
    const double n = (onset_halves - 2) * (s.n_samples - 2.0);
    // Variance of a mean of squares: 2/n (1 + 2 sum of squared correlations); second differences of white noise have
    // -4/6 and 1/6.
    return {sum / n, square_root(2.0 * (1.0 + 2.0 * (16.0 + 1.0) / 36.0) / n)};
}

// sigma^2: as configured, or that of the residuals where it differs significantly. False: the residuals are not noise,
// because second differences show less.
bool find_noise(RelockProfileState& s, double residual_sq) noexcept {
    const double freedom = (onset_halves - 2) * (s.n_samples - 1.0) - 3.0;
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

// Test of the model for the best onset: the residuals of the first five halves.
bool is_explained(const RelockProfileState& s) noexcept {
    const double freedom = onset_halves * s.n_samples - (onset_halves + 2.0);
    const double residual_sq =
        weighted_sum_sq(s, 0, onset_halves) - s.information.fitted_sq - 2.0 * s.noise_sq_lambda2 * s.mixture.log_best;
    return deviation(residual_sq, freedom, s.noise_sq_lambda2) < max_deviation;
}

void try_onsets(RelockProfileState& s, std::int32_t from, std::int32_t to) noexcept {
    for (std::int32_t i = from; i < to; ++i) try_onset(s, i);
}

// Information filter from the 5th half back to the third, the noise, and the first onsets. False: the model does not
// hold.
bool begin_onsets(RelockProfileState& s) noexcept {
    s.scale_lambda = square_root(s.halves[0].sum_sq / s.n_samples + s.noise_sq_lambda2 + 1e-24);
    s.information = {};
    for (std::size_t k = onset_halves; k-- > 2;) (void)absorb(s.halves[k], s.powers, cubic_ridge(s), s.information);
    const double residual_sq = weighted_sum_sq(s, 2, onset_halves) - s.information.fitted_sq - explained(s.information);
    if (!find_noise(s, residual_sq)) return false;
    s.mixture = {};
    try_onsets(s, 0, onsets_in_first_half);
    return true;
}

// The other onsets.
bool end_onsets(RelockProfileState& s) noexcept {
    try_onsets(s, onsets_in_first_half, n_onsets);
    return is_explained(s);
}

// Forward smoothing: m_k of each half, and its covariance with all earlier ones, which are carried along with the
// state.
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

// Backward over all halves behind the first tick, forward from the average of the onsets.
void smooth(RelockProfileState& s) noexcept {
    s.information = {};
    for (std::size_t k = profile_halves; k-- > 2;)
        s.gains[k] = absorb(s.halves[k], s.powers, cubic_ridge(s), s.information);
    average_onsets(s);
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

// The sums of (1) that one half needs: of y u^p, of y^2 and of squared second differences.
void add_samples(const DetuningSamples& samples, RelockProfileState& s) noexcept {
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

void add_record(const RecordedSquare& recorded, RelockProfileState& s) noexcept {
    const auto k = static_cast<std::size_t>(s.n_halves);
    s.columns_known = s.columns_known && recorded.known;
    s.profile.mean_sq_lambda2[k] = recorded.mean_sq_lambda2;
    s.profile.covariance_lambda4[k][k] = recorded.variance_lambda4;
}

void add_light(const DetuningSamples& samples, RelockProfileState& s) noexcept {
    if (s.n_halves == 0) s.n_samples = samples.n;
    if (samples.n == 0 || samples.n != s.n_samples)
        use_records(s);
    else
        add_samples(samples, s);
}

}  // namespace

void enter_gap(RelockProfileState& state) noexcept {
    if (state.armed && state.n_halves == 0) return;  // no half was added since
    std::construct_at(&state);
    state.armed = true;
}

void step(const CompensationConstants& gyro, const RelockProfileConfig& config, RelockProfileState& state,
          const HalfRecord& half, LightSamples light) noexcept {
    if (!state.armed || state.n_halves == profile_halves) return;
    if (state.n_halves == 0) {
        state.columns_known = true;
        state.noise_sq_lambda2 = square(light_noise_lambda(gyro));
    }
    const RecordedSquare recorded = recorded_square(gyro, half);
    add_record(recorded, state);
    if (state.n_halves == 0 || state.n_samples > 0) {
        DetuningSamples samples;
        if (!recorded.refused) read_samples(gyro, config, half, light, samples);
        add_light(samples, state);
    }
    ++state.n_halves;
    if (state.n_samples > 0 && state.n_halves == onset_halves && !begin_onsets(state)) use_records(state);
    if (state.n_samples > 0 && state.n_halves == onset_halves + 2 && !end_onsets(state)) use_records(state);
    if (state.n_halves < profile_halves) return;
    if (state.n_samples > 0)
        smooth(state);
    else
        use_records(state);
}

}  // namespace zlg::core
