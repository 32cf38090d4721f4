#include <zlg/core/light_monitor.hpp>

#include <zlg/core/maths.hpp>

namespace zlg::core {
namespace {

constexpr std::int32_t spoilt_believed = 2;
constexpr std::int32_t unlike_believed = 8;
constexpr double noisy_deviations = 6.0;

// An imbalance that moves the reading by this much; light noise in the mean of a half is ten times smaller.
constexpr double least_unbalanced_lambda = 0.02;

// Noise so large that the mean of a half is no guide.
constexpr double most_steering_noise_lambda = 0.05;
constexpr std::size_t fewest_for_noise = 4;

// Of the bias: several times its rounding, and what 0.1 wavelength takes from it.
constexpr double most_missing_ratio = 0.03;

// There the next mode has its centre: no detuning is that large.
constexpr double next_mode_lambda = 0.5;

// A row of halves, counted up to what is believed.
bool row(std::int32_t& n, bool so, std::int32_t believed) noexcept {
    n = so ? n + (n < believed) : 0;
    return n >= believed;
}

bool is_still(std::span<const float> x, float last) noexcept {
    const float first = x.front();
    return first == last && first == x[x.size() / 2] && first == x.back() && first != 0.0f;
}

// No number is like no other: 0 stands for it, which is never still.
float remembered(float sample) noexcept { return is_finite(static_cast<double>(sample)) ? sample : 0.0f; }

bool sees_still(LightMonitorState& s, const LightMonitorInput& in) noexcept {
    bool still = is_still(in.light_a, s.last_a);
    s.last_a = remembered(in.light_a.front());
    if (!in.light_b.empty()) {
        still = is_still(in.light_b, s.last_b) || still;
        s.last_b = remembered(in.light_b.front());
    }
    return still;
}

// What does not follow the sign of the bias, of two halves of opposite sign: -1 where beam B is too bright, 1 for A.
int side_of(const LightMonitorConfig& c, const LightMonitorState& s, const LightMonitorInput& in) noexcept {
    const double odd_lambda = 0.5 * in.sign * (in.detuning.value() - s.last_lambda);
    const double limit_lambda =
        2.0 * c.noise.value() > least_unbalanced_lambda ? 2.0 * c.noise.value() : least_unbalanced_lambda;
    if (odd_lambda > limit_lambda) return 1;
    return odd_lambda < -limit_lambda ? -1 : 0;
}

// A row of halves on one side, or of halves on none, settles it; so does a bias that lacks nothing. On the way to a lock the detuning itself changes.
void weigh_beams(const LightMonitorConfig& c, LightMonitorState& s, const LightMonitorInput& in) noexcept {
    const int side = side_of(c, s, in);
    if (side == s.side) {
        s.n_side += s.n_side < unlike_believed;
    } else {
        s.side = static_cast<std::int8_t>(side);
        s.n_side = 1;
    }
    if (in.settled && s.n_side >= unlike_believed) s.is_unbalanced = side != 0;
    // Light noise stands in the mean square, but takes nothing from the bias.
    const double above_noise = 0.5 * (in.mean_sq_lambda2 + s.last_lambda2) - 4.0 * c.noise.value() * c.noise.value();
    const double claimed_ratio = c.bias_chi * above_noise;
    // A rotation that changes adds to the beat or takes from it: only what is claimed can be missing.
    const double missing_ratio = in.deficit_ratio > 0.0 ? claimed_ratio - in.deficit_ratio : claimed_ratio;
    if (in.settled && in.beats && missing_ratio > most_missing_ratio) s.is_unbalanced = true;
}

// The mean of two halves in place of the second one. Light that is not of this gyro says nothing at all.
void balance(const LightMonitorConfig& c, LightMonitorState& s, const LightMonitorInput& in,
             LightMonitorOutput& out) noexcept {
    if (s.has_last) weigh_beams(c, s, in);
    out.unbalanced = s.is_unbalanced;
    if (s.is_unbalanced) {
        out.detuning = Wavelengths{0.5 * (in.detuning.value() + s.last_lambda)};
        out.has_mean_square = false;
        out.usable = out.usable && s.has_last;
    }
    s.last_lambda = in.detuning.value();
    s.last_lambda2 = in.mean_sq_lambda2;
    s.has_last = true;
    const double most_lambda = next_mode_lambda * c.most_gain + 4.0 * c.noise.value();
    if (!(out.detuning.value() < most_lambda && out.detuning.value() > -most_lambda)) {
        out.usable = out.has_mean_square = false;
    }
}

// Square of the noise of a sample, as detuning: of neighbours, because the perimeter moves too, but not so fast.
double noise_lambda2(const LightMonitorInput& in) noexcept {
    const std::size_t n = in.light_a.size();
    const bool both = !in.light_b.empty();
    const float* const beam_a = in.light_a.data();
    const float* const beam_b = both ? in.light_b.data() : beam_a;
    // On its way to a lock the light rises by much from sample to sample, but evenly.
    const auto bend = [beam_a, beam_b, both](std::size_t k) {
        const auto rise = [](const float* x) { return static_cast<double>(x[1]) - static_cast<double>(x[0]); };
        const double a = rise(beam_a + k);
        const double next_a = rise(beam_a + k + 1);
        if (!both) return 2.0 * next_a - 2.0 * a;
        return (next_a - rise(beam_b + k + 1)) - (a - rise(beam_b + k));
    };
    const double first = bend(0);
    const double middle = bend(n / 2 - 1);
    const double last = bend(n - 3);
    const double light = both ? in.light : 2.0 * in.light;
    const double scale = in.signal_per_lambda * light;
    return (first * first + middle * middle + last * last) / (18.0 * scale * scale);
}

// The mean square of noise is no detuning; at worst not even the mean is.
void look_for_noise(const LightMonitorConfig& c, LightMonitorState& s, const LightMonitorInput& in,
                    LightMonitorOutput& out) noexcept {
    if (in.light_a.size() < fewest_for_noise) return;
    const double noise = noise_lambda2(in);
    const double usual_lambda = noisy_deviations * c.noise.value();
    const bool spread = noise > usual_lambda * usual_lambda;
    // The half in which the noise ends holds some of it.
    if (spread || s.n_noisy > 0) out.has_mean_square = false;
    out.noisy = row(s.n_noisy, spread, spoilt_believed);
    if (!spread) return;
    if (noise > most_steering_noise_lambda * most_steering_noise_lambda) out.usable = false;
}

}  // namespace

LightMonitorOutput step(const LightMonitorConfig& config, LightMonitorState& state,
                        const LightMonitorInput& input) noexcept {
    LightMonitorOutput out{.usable = input.usable,
                           .has_mean_square = input.usable,
                           .detuning = input.detuning,
                           .mean_sq_lambda2 = input.mean_sq_lambda2};
    const bool watches = config.noise >= least_noise;
    out.contradicted = row(state.n_contradicted, input.beats && !input.two_way && !input.dark, unlike_believed);
    if (watches && !input.light_a.empty()) out.stuck = row(state.n_stuck, sees_still(state, input), spoilt_believed);
    if (watches && input.usable) look_for_noise(config, state, input, out);
    // Light that comes back has to show first that its beams are alike.
    if (out.contradicted) state.is_unbalanced = true;
    if (watches && input.usable) {
        balance(config, state, input, out);
    } else {
        state.has_last = false;
        state.n_side = 0;
    }
    if (out.stuck) out.usable = out.has_mean_square = false;
    return out;
}

}  // namespace zlg::core
