#include <zlg/core/control/light_monitor.hpp>

#include <array>

#include <zlg/core/common/maths.hpp>

namespace zlg::core {
namespace {

constexpr std::int32_t spoilt_proven = 2;
constexpr std::int32_t unlike_proven = 8;
constexpr double noisy_deviations = 6.0;

// An imbalance that moves the reading by this much; light noise in the mean of a half is ten times smaller.
constexpr double min_unbalanced_lambda = 0.02;

// Noise so large that the mean of a half is no guide.
constexpr double max_steering_noise_lambda = 0.05;
constexpr std::size_t fewest_for_noise = 4;

// Of the bias: several times its rounding, and what 0.1 wavelength takes from it.
constexpr double max_missing_ratio = 0.03;

// There the next mode has its centre: no detuning is that large.
constexpr double next_mode_lambda = 0.5;

// A row of halves, counted up to what is enough.
bool row(std::int32_t& n, bool so, std::int32_t enough) noexcept {
    n = so ? n + (n < enough) : 0;
    return n >= enough;
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
        2.0 * c.noise.value() > min_unbalanced_lambda ? 2.0 * c.noise.value() : min_unbalanced_lambda;
    if (odd_lambda > limit_lambda) return 1;
    return odd_lambda < -limit_lambda ? -1 : 0;
}

// A row of halves on one side, or of halves on none, settles it; so does a bias that lacks nothing. On the way to a lock the detuning itself changes.
void weigh_beams(const LightMonitorConfig& c, LightMonitorState& s, const LightMonitorInput& in) noexcept {
    const int side = side_of(c, s, in);
    if (side == s.side) {
        s.n_side += s.n_side < unlike_proven;
    } else {
        s.side = static_cast<std::int8_t>(side);
        s.n_side = 1;
    }
    if (in.settled && s.n_side >= unlike_proven) s.is_unbalanced = side != 0;
    // Light noise stands in the mean square, but takes nothing from the bias.
    const double above_noise = 0.5 * (in.mean_sq_lambda2 + s.last_lambda2) - 4.0 * c.noise.value() * c.noise.value();
    const double claimed_ratio = c.bias_chi * above_noise;
    // A rotation that changes adds to the beat or takes from it: only what is claimed can be missing.
    const double missing_ratio = in.deficit_ratio > 0.0 ? claimed_ratio - in.deficit_ratio : claimed_ratio;
    if (in.settled && in.beats && missing_ratio > max_missing_ratio) s.is_unbalanced = true;
}

// The mean of two halves in place of the second one. Light that is not of this gyro says nothing at all.
void balance(const LightMonitorConfig& c, LightMonitorState& s, const LightMonitorInput& in,
             LightMonitorOutput& out) noexcept {
    if (s.has_last) weigh_beams(c, s, in);
    // In a settled gyro light that was gone comes back as it went: by one beam more than by the other, first of all.
    out.returns = s.was_dark && in.settled;
    out.unbalanced = s.is_unbalanced || out.returns;
    s.was_dark = false;
    if (out.unbalanced) {
        out.detuning = Wavelengths{0.5 * (in.detuning.value() + s.last_lambda)};
        out.has_mean_square = false;
        out.usable = out.usable && s.has_last;
    }
    s.last_lambda = in.detuning.value();
    s.last_lambda2 = in.mean_sq_lambda2;
    s.has_last = true;
    const double max_lambda = next_mode_lambda * c.max_gain + 4.0 * c.noise.value();
    if (!(out.detuning.value() < max_lambda && out.detuning.value() > -max_lambda)) {
        out.usable = out.has_mean_square = false;
        out.withheld = true;
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

// Of what the curve leaves of the light: errors of its own, as detuning.
constexpr double curve_error_lambda = 3e-4;
constexpr std::size_t fewest_for_motion = 5;
constexpr std::size_t max_samples = 64;

// A sample as detuning, through the curve.
CurvePoint detuning_at(const LightMonitorInput& in, std::size_t k) noexcept {
    const double a = static_cast<double>(in.light_a[k]);
    const bool both = !in.light_b.empty();
    const double b = both ? static_cast<double>(in.light_b[k]) : in.light;
    const double signal = (a - b) / (both ? a + b : b);
    const double apparent_lambda = in.sign * signal / in.signal_per_lambda;
    return in.curve == nullptr ? CurvePoint{.detuning_lambda = apparent_lambda}
                               : true_detuning(*in.curve, apparent_lambda);
}

// On a fast way to a lock the light bends, by the motion and by the curve, far more than a quiet converter's noise. Fourth
// differences of the detuning are free of every smooth motion; a corner of it spoils those of one third of the half, or two.
//
// usual_lambda2  noise of a sample, as detuning at the centre, that is still usual.
// return         whether there is more on average, and a good part of that in every third.
bool is_noisy_throughout(const LightMonitorInput& in, double usual_lambda2) noexcept {
    const std::size_t n = in.light_a.size() < max_samples ? in.light_a.size() : max_samples;
    if (n < fewest_for_motion) return true;
    constexpr double gain_sq = 70.0;  // of white noise: 1 + 16 + 36 + 16 + 1
    constexpr double good_part = 0.25;
    const std::size_t n_differences = n - 4;
    const std::size_t n_parts = n_differences < 6 ? 1 : 3;
    std::array<CurvePoint, 5> window{};
    for (std::size_t k = 0; k < 4; ++k) window[k + 1] = detuning_at(in, k);
    double noise_sum = 0.0;
    double usual_sum = 0.0;
    for (std::size_t part = 1, k = 0; part <= n_parts; ++part) {
        double noise = 0.0;
        double usual = 0.0;
        for (; k < part * n_differences / n_parts; ++k) {
            for (std::size_t j = 0; j < 4; ++j) window[j] = window[j + 1];
            window[4] = detuning_at(in, k + 4);
            const auto y = [&window](std::size_t j) { return window[j].detuning_lambda; };
            const double difference = y(0) + y(4) - 4.0 * (y(1) + y(3)) + 6.0 * y(2);
            noise += difference * difference / gain_sq;
            usual += window[2].slope * window[2].slope * usual_lambda2 + curve_error_lambda * curve_error_lambda;
        }
        if (!(noise > good_part * usual)) return false;
        noise_sum += noise;
        usual_sum += usual;
    }
    return noise_sum > usual_sum;
}

// Where a half begins and where it ends, as detuning, by straight lines through the samples near there.
struct Ends {
    double first_lambda = 0.0;
    double last_lambda = 0.0;
    double slope_sq = 1.0;  // of the curve: what it makes of the variance of the noise
};

constexpr std::size_t line_samples = 8;

Ends ends_of(const LightMonitorInput& in) noexcept {
    constexpr double n = static_cast<double>(line_samples);
    constexpr double lever_sq = n * (n * n - 1.0) / 12.0;
    const std::size_t from_last = in.light_a.size() - line_samples;
    double first_sum = 0.0;
    double last_sum = 0.0;
    double first_rise = 0.0;
    double last_rise = 0.0;
    Ends ends{.slope_sq = 0.0};
    for (std::size_t k = 0; k < line_samples; ++k) {
        const double lever = static_cast<double>(k) - 0.5 * (n - 1.0);
        const CurvePoint first = detuning_at(in, k);
        const CurvePoint last = detuning_at(in, from_last + k);
        first_sum += first.detuning_lambda;
        first_rise += lever * first.detuning_lambda;
        last_sum += last.detuning_lambda;
        last_rise += lever * last.detuning_lambda;
        ends.slope_sq += 0.5 * (first.slope * first.slope + last.slope * last.slope) / n;
    }
    ends.first_lambda = first_sum / n - 0.5 * n * first_rise / lever_sq;
    ends.last_lambda = last_sum / n + 0.5 * n * last_rise / lever_sq;
    return ends;
}

// The perimeter does not jump where the bias is reversed; what one beam has lost changes its sign there. Away from a lock
// that, times the detuning, stands in the mean square long before it is large.
//
// return  whether this half and the one before do not fit together, or the last ones do not on average.
bool jumps(const LightMonitorConfig& c, LightMonitorState& s, const LightMonitorInput& in) noexcept {
    const bool seen = in.closed && in.light_a.size() >= line_samples && !in.light_b.empty();
    const bool follows = seen && s.has_end;
    const double before_lambda = s.end_lambda;
    s.has_end = seen;
    if (!seen) return false;
    const Ends ends = ends_of(in);
    s.end_lambda = ends.last_lambda;
    if (!follows) s.jump_lambda = 0.0;
    if (!follows) return false;
    constexpr double deviations = 8.0;  // at 5, one of 400 switches without a fault was refused
    constexpr double lines_sq = 1.01;   // variance of two ends, of that of a sample
    constexpr double bend = 0.1;        // of a fast way to a lock, of what it comes to in a half
    const double way_lambda = ends.last_lambda - ends.first_lambda;
    const double allowed = bend * (way_lambda < 0.0 ? -way_lambda : way_lambda);
    const double noise_sq = lines_sq * ends.slope_sq * c.noise.value() * c.noise.value();
    const double jump = in.sign * (ends.first_lambda - before_lambda);
    constexpr double weight = 0.4;  // a quarter of the variance
    s.jump_lambda += weight * (jump - s.jump_lambda);
    const auto exceeds = [allowed](double x, double variance) {
        const double over = (x < 0.0 ? -x : x) - allowed;
        return over > 0.0 && over * over > deviations * deviations * variance;
    };
    return exceeds(jump, noise_sq) || exceeds(s.jump_lambda, 0.25 * noise_sq);
}

// On its way to a lock a gyro gets brighter, if anything: light that is less than a half ago has lost a part of a beam.
// before  both beams at the beginning of the half before; 0: not known
bool fades(const LightMonitorConfig& c, const LightMonitorInput& in, double before) noexcept {
    const std::size_t n = in.light_a.size();
    if (!(before > 0.0) || n < line_samples || in.light_b.empty()) return false;
    double sum = 0.0;
    for (std::size_t k = n - line_samples; k < n; ++k) {
        sum += static_cast<double>(in.light_a[k]) + static_cast<double>(in.light_b[k]);
    }
    constexpr double n_lines = static_cast<double>(line_samples);
    constexpr double deviations_sq = 64.0;
    const double lost_ratio = 1.0 - sum / (n_lines * before);
    const double noise_ratio = c.noise.value() * in.signal_per_lambda;
    return lost_ratio > 0.0 &&
           lost_ratio * lost_ratio > deviations_sq * (1.0 + 1.0 / n_lines) * noise_ratio * noise_ratio;
}

// The mean square of noise is no detuning; at worst not even the mean is.
void look_for_noise(const LightMonitorConfig& c, LightMonitorState& s, const LightMonitorInput& in,
                    LightMonitorOutput& out) noexcept {
    if (in.light_a.size() < fewest_for_noise) return;
    const double noise = noise_lambda2(in);
    const double usual_lambda = noisy_deviations * c.noise.value();
    const double usual_lambda2 = usual_lambda * usual_lambda;
    const bool spread = noise > usual_lambda2 && is_noisy_throughout(in, usual_lambda2);
    // The half in which the noise ends holds some of it.
    out.withheld = spread || s.n_noisy > 0;
    if (out.withheld) out.has_mean_square = false;
    out.noisy = row(s.n_noisy, spread, spoilt_proven);
    if (!spread) return;
    if (noise > max_steering_noise_lambda * max_steering_noise_lambda) out.usable = false;
}

}  // namespace

LightMonitorOutput step(const LightMonitorConfig& config, LightMonitorState& state,
                        const LightMonitorInput& input) noexcept {
    LightMonitorOutput out{.usable = input.usable,
                           .has_mean_square = input.usable,
                           .detuning = input.detuning,
                           .mean_sq_lambda2 = input.mean_sq_lambda2};
    const bool watches = config.noise >= min_noise;
    const double before = state.has_end ? static_cast<double>(state.last_a) + static_cast<double>(state.last_b) : 0.0;
    out.contradicted = row(state.n_contradicted, input.beats && !input.two_way && !input.dark, unlike_proven);
    if (watches && !input.light_a.empty()) out.stuck = row(state.n_stuck, sees_still(state, input), spoilt_proven);
    if (watches && input.usable) look_for_noise(config, state, input, out);
    // On the way to a lock only: a settled gyro has other means, which cost less.
    const bool is_whole = watches && input.usable && !out.withheld && !input.settled;
    if (!is_whole) state.has_end = false;
    if (is_whole && (jumps(config, state, input) || (input.closed && fades(config, input, before))))
        state.is_unbalanced = true;
    // Light that comes back has to show first that its beams are alike.
    if (out.contradicted) state.is_unbalanced = true;
    if (watches && input.usable) {
        balance(config, state, input, out);
    } else {
        state.has_last = false;
        state.n_side = 0;
        state.was_dark = watches && input.settled && !input.two_way;
    }
    if (out.stuck) out.usable = out.has_mean_square = false;
    return out;
}

}  // namespace zlg::core
