#include <zlg/core/control/light_monitor.hpp>

#include <array>

#include <zlg/core/common/maths.hpp>
#include <zlg/core/records.hpp>

#include "common/bounds.hpp"

namespace zlg::core {
namespace {

// Halves in a row before a fault is reported. These and the other limits of this file were set by hand and judged by
// zlg_trials faults (docs/faults.md), where no other reason is given.
constexpr std::int32_t spoilt_debounce = 2;
constexpr std::int32_t balance_debounce = 8;
constexpr std::int32_t contradicted_debounce = 8;
constexpr double noisy_deviations = 6.0;
constexpr double jump_deviations = 8.0;  // at 5, one of 400 switches without a fault was refused

// An imbalance that moves the reading by this much; light noise in the mean of a half is ten times smaller.
constexpr double min_unbalanced_lambda = 0.02;

// Noise so large that the mean of a half is no guide, in this half or in a mean of four: three differences alone miss
// it in one half of forty.
constexpr double max_steering_noise_lambda = 0.05;
constexpr double noise_followed = 0.25;
constexpr std::size_t min_noise_samples = 4;

// Relative to the bias: several times its rounding, and nearly what 0.1 wavelength costs it (chi dl^2 = 0.036).
constexpr double max_missing_ratio = 0.03;

// The centre of the next mode: no detuning is that large.
constexpr double next_mode_lambda = 0.5;

// Whether a beam shows one number throughout, that of the half before. What is no number is remembered as 0, which
// never counts.
bool is_still(std::span<const float> x, float& last) noexcept {
    const float first = x.front();
    const bool still = first == last && first == x[x.size() / 2] && first == x.back() && first != 0.0f;
    last = is_finite(static_cast<double>(first)) ? first : 0.0f;
    return still;
}

bool is_any_still(LightMonitorState& s, const SyncDetectorInput& light) noexcept {
    const bool still_a = is_still(light.light_a, s.last_a);
    return (!light.light_b.empty() && is_still(light.light_b, s.last_b)) || still_a;
}

// The part of the light signal (A - B)/(A + B) that keeps its sign as the bias turns, as detuning; in the detuning
// itself it alternates. 1: beam A is too bright, -1: B.
int side_of(const MonitorLimits& c, const LightMonitorState& s, const LightMonitorInput& in) noexcept {
    const double odd_lambda = 0.5 * in.light.sign * (in.read.detuning.value() - s.last_lambda);
    const double limit_lambda =
        2.0 * c.light_noise.value() > min_unbalanced_lambda ? 2.0 * c.light_noise.value() : min_unbalanced_lambda;
    if (odd_lambda > limit_lambda) return 1;
    return odd_lambda < -limit_lambda ? -1 : 0;
}

// In a settled gyro: unbalanced after eight halves in a row on one side, balanced after eight on none, or at once where
// the side changes, as it does where the perimeter swings and no beam has faded; unbalanced at once where the detuning
// that is read should have weakened the bias more. On the way to a lock the detuning itself changes.
void weigh_beams(const MonitorLimits& c, LightMonitorState& s, const LightMonitorInput& in) noexcept {
    const int side = side_of(c, s, in);
    s.n_side = side == s.side ? s.n_side + (s.n_side < balance_debounce) : 1;
    s.side = static_cast<std::int8_t>(side);
    if (in.settled && s.n_side >= balance_debounce) s.is_unbalanced = side != 0;
    if (in.settled && side != 0) {
        if (side == -s.last_side) s.is_unbalanced = false;
        s.last_side = static_cast<std::int8_t>(side);
    }
    // Light noise is in the mean square, sigma^2, but does not weaken the bias; (2 sigma)^2 leaves a margin.
    const double above_noise =
        0.5 * (in.read.mean_sq_lambda2 + s.last_lambda2) - 4.0 * c.light_noise.value() * c.light_noise.value();
    const double claimed_ratio = c.bias_chi * above_noise;
    // A rotation that changes may increase the beat as well: a surplus counts as no deficit.
    const double missing_ratio = in.deficit_ratio > 0.0 ? claimed_ratio - in.deficit_ratio : claimed_ratio;
    if (in.settled && in.light.beats && missing_ratio > max_missing_ratio) s.is_unbalanced = true;
}

// The mean of two halves replaces the second one where the beams are unbalanced; an impossible detuning is withheld.
void balance(const MonitorLimits& c, LightMonitorState& s, const LightMonitorInput& in,
             LightMonitorOutput& out) noexcept {
    if (s.has_last) weigh_beams(c, s, in);
    // In a settled gyro light returns unevenly: at first one beam is brighter than the other.
    out.returns = s.was_dark && in.settled;
    out.unbalanced = s.is_unbalanced || out.returns || out.jumps;
    s.was_dark = false;
    const double now_lambda = in.read.detuning.value();
    if (out.unbalanced) {
        in.read.detuning = Wavelengths{0.5 * (now_lambda + s.last_lambda)};
        out.has_mean_square = false;
        in.read.usable = in.read.usable && s.has_last;
    }
    s.last_lambda = now_lambda;
    s.last_lambda2 = in.read.mean_sq_lambda2;
    s.has_last = true;
    if (!(size(in.read.detuning.value()) < next_mode_lambda * c.light_gain + 4.0 * c.light_noise.value())) {
        in.read.usable = out.has_mean_square = false;
        out.withheld = true;
    }
}

// Square of the noise of a sample, as detuning, from three second differences (6 sigma^2 each): the perimeter moves
// too, but more slowly than from sample to sample.
double noise_lambda2(const LightMonitorInput& in) noexcept {
    const std::size_t n = in.light.light_a.size();
    const bool both = !in.light.light_b.empty();
    const float* const beam_a = in.light.light_a.data();
    const float* const beam_b = both ? in.light.light_b.data() : beam_a;
    // On the way to a lock the light changes by much from sample to sample, but evenly: second differences remove that.
    const double weight = in.light.weight_b.weight;
    const auto second_difference = [beam_a, beam_b, both, weight](std::size_t k) {
        const auto rise = [](const float* x) { return static_cast<double>(x[1]) - static_cast<double>(x[0]); };
        const double a = rise(beam_a + k);
        const double next_a = rise(beam_a + k + 1);
        if (!both) return 2.0 * next_a - 2.0 * a;
        return (next_a - a) - weight * (rise(beam_b + k + 1) - rise(beam_b + k));
    };
    const double first = second_difference(0);
    const double middle = second_difference(n / 2 - 1);
    const double last = second_difference(n - 3);
    const double light = both ? in.read.light : 2.0 * in.read.light;
    const double scale = in.detector.discriminator_per_lambda * light;
    return (first * first + middle * middle + last * last) / (18.0 * scale * scale);
}

// Errors of the curve of the discriminator itself, as detuning.
constexpr double curve_error_lambda = 3e-4;
constexpr std::size_t min_motion_samples = 5;

// A sample as detuning, through the curve.
CurvePoint detuning_at(const LightMonitorInput& in, std::size_t k) noexcept {
    const double a = static_cast<double>(in.light.light_a[k]);
    const bool both = !in.light.light_b.empty();
    const double b = both ? in.light.weight_b.of(static_cast<double>(in.light.light_b[k])) : in.read.light;
    const double signal = (a - b) / (both ? a + b : b);
    return true_detuning(in.detector.curve, in.light.sign * signal / in.detector.discriminator_per_lambda);
}

// On a fast way to a lock the second differences of the light far exceed the noise of a quiet converter. Fourth
// differences of the detuning are free of smooth motion, and a corner affects at most two thirds of the half.
//
// limit_lambda2  largest variance of a sample, as detuning at the centre, that is no fault.
// return         whether there is more on average, and a good part of that in every third.
bool is_noisy_throughout(const LightMonitorInput& in, double limit_lambda2) noexcept {
    const std::size_t n =
        in.light.light_a.size() < max_light_samples ? in.light.light_a.size() : std::size_t{max_light_samples};
    if (n < min_motion_samples) return true;
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
            usual += window[2].slope * window[2].slope * limit_lambda2 + curve_error_lambda * curve_error_lambda;
        }
        if (!(noise > good_part * usual)) return false;
        noise_sum += noise;
        usual_sum += usual;
    }
    return noise_sum > usual_sum;
}

constexpr std::size_t line_samples = 8;

// The detuning through the eight samples from one on, by least squares: in their middle, and how much it rises over
// them.
struct Line {
    double middle_lambda = 0.0;
    double rise_lambda = 0.0;
    double slope_sq = 0.0;  // of the curve: what it makes of the variance of the noise
};

Line line_from(const LightMonitorInput& in, std::size_t first) noexcept {
    constexpr double n = static_cast<double>(line_samples);
    Line line;
    for (std::size_t k = 0; k < line_samples; ++k) {
        const CurvePoint x = detuning_at(in, first + k);
        line.middle_lambda += x.detuning_lambda / n;
        line.rise_lambda += (static_cast<double>(k) - 0.5 * (n - 1.0)) * x.detuning_lambda * 12.0 / (n * n - 1.0);
        line.slope_sq += x.slope * x.slope / n;
    }
    return line;
}

// Error of the lines by the bend of a fast way to a lock, over the changes in this half and in the one before. It grows
// with the square of what a line takes of the half; from 16 samples on the earlier half, whose line is at its flat end,
// adds nothing.
double bend_lambda(std::size_t n_samples, double change_lambda, double change_before_lambda) noexcept {
    constexpr double bend_ratio = 0.1;
    const double shortness = 16.0 / static_cast<double>(n_samples);
    if (!(shortness > 1.0)) return bend_ratio * change_lambda;
    return bend_ratio * shortness * shortness * (change_lambda + change_before_lambda);
}

// The detuning does not jump where the bias is reversed, but the error by a faded beam changes its sign there. Far from
// a lock the mean square holds twice that error times the detuning, so that even a small error must be found.
//
// return  whether the jump between the half before and this one, or its smoothed value, exceeds 8 sigma, and what an
// offset
//         of the photodiodes that is not known yet may make of it.
bool jumps(const MonitorLimits& c, LightMonitorState& s, const LightMonitorInput& in,
           LightMonitorOutput& out) noexcept {
    const bool seen = in.closed && in.light.light_a.size() >= line_samples && !in.light.light_b.empty();
    const bool follows = seen && s.has_end;
    const double before_lambda = s.end_lambda;
    const double change_before_lambda = static_cast<double>(s.change_lambda);
    s.has_end = seen;
    if (!seen) return false;
    const Line first = line_from(in, 0);
    const Line last = line_from(in, in.light.light_a.size() - line_samples);
    const double first_lambda = first.middle_lambda - 0.5 * first.rise_lambda;
    s.end_lambda = last.middle_lambda + 0.5 * last.rise_lambda;
    const double change_lambda = size(s.end_lambda - first_lambda);
    s.change_lambda = static_cast<float>(change_lambda);
    if (!follows) s.jump_lambda = 0.0;
    if (!follows) return false;
    constexpr double lines_sq = 1.01;  // variance of the difference of two ends over that of a sample
    const double allowed = bend_lambda(in.light.light_a.size(), change_lambda, change_before_lambda);
    const double slope_sq = 0.5 * (first.slope_sq + last.slope_sq);
    const double noise_sq = lines_sq * slope_sq * square(c.light_noise.value());
    const double jump = in.light.sign * (first_lambda - before_lambda);
    constexpr double weight = 0.4;  // a quarter of the variance
    s.jump_lambda += weight * (jump - s.jump_lambda);
    const auto exceeds = [allowed](double x, double variance) {
        const double over = size(x) - allowed;
        return over > 0.0 && over * over > jump_deviations * jump_deviations * variance;
    };
    s.jump = {jump, noise_sq + square(allowed), slope_sq};
    out.has_jump = true;
    out.jumps = exceeds(jump, noise_sq) || exceeds(s.jump_lambda, 0.25 * noise_sq);
    const double unknown_sq = slope_sq * in.unknown_lambda2;
    return exceeds(jump, noise_sq + unknown_sq) || exceeds(s.jump_lambda, 0.25 * noise_sq + unknown_sq);
}

// Less light at the end of this half than at the start of the half before means that a beam has faded: on the way to a
// lock the light gets brighter, but for what depends on the field, on the detuning near the centre and on the isotopes:
// 0.3 % in healthy lasers. before  first sample of the half before, sum of both beams; 0: not known.
bool fades(const MonitorLimits& c, const LightMonitorInput& in, double before) noexcept {
    const std::size_t n = in.light.light_a.size();
    if (!(before > 0.0) || n < line_samples || in.light.light_b.empty()) return false;
    double sum = 0.0;
    for (std::size_t k = n - line_samples; k < n; ++k) {
        sum +=
            static_cast<double>(in.light.light_a[k]) + in.light.weight_b.of(static_cast<double>(in.light.light_b[k]));
    }
    constexpr double n_samples = static_cast<double>(line_samples);
    const double lost_ratio = 1.0 - sum / (n_samples * before);
    constexpr double usual_ratio = 0.005;
    const double noise_ratio = c.light_noise.value() * in.detector.discriminator_per_lambda;
    return lost_ratio > usual_ratio && lost_ratio * lost_ratio > jump_deviations * jump_deviations *
                                                                     (1.0 + 1.0 / n_samples) * noise_ratio *
                                                                     noise_ratio;
}

// Noise spoils the mean square of the detuning; beyond 0.05 wavelength the mean as well.
void look_for_noise(const MonitorLimits& c, LightMonitorState& s, const LightMonitorInput& in,
                    LightMonitorOutput& out) noexcept {
    if (in.light.light_a.size() < min_noise_samples) return;
    const double found_lambda2 = noise_lambda2(in);
    const double limit_lambda = noisy_deviations * c.light_noise.value();
    const double limit_lambda2 = limit_lambda * limit_lambda;
    const bool is_noisy = found_lambda2 > limit_lambda2 && is_noisy_throughout(in, limit_lambda2);
    // The half in which the noise ends still has some of it.
    out.withheld = is_noisy || s.n_noisy > 0;
    if (out.withheld) out.has_mean_square = false;
    out.noisy = debounced(s.n_noisy, is_noisy, spoilt_debounce);
    s.noise_lambda2 = is_noisy ? s.noise_lambda2 + noise_followed * (found_lambda2 - s.noise_lambda2) : 0.0;
    const double worse_lambda2 = found_lambda2 > s.noise_lambda2 ? found_lambda2 : s.noise_lambda2;
    if (is_noisy && worse_lambda2 > square(max_steering_noise_lambda)) in.read.usable = false;
}

}  // namespace

LightMonitorOutput step(const MonitorLimits& limits, LightMonitorState& state,
                        const LightMonitorInput& input) noexcept {
    LightMonitorOutput out{.has_mean_square = input.read.usable};
    const bool watches = limits.light_noise >= min_noise;
    const bool reads = watches && input.read.usable;
    const double last_b = input.light.weight_b.of(static_cast<double>(state.last_b));
    const double before = state.has_end ? static_cast<double>(state.last_a) + last_b : 0.0;
    out.contradicted = debounced(state.n_contradicted, input.light.beats && !input.read.two_way && !input.read.dark,
                                 contradicted_debounce);
    if (watches && !input.light.light_a.empty())
        out.stuck = debounced(state.n_stuck, is_any_still(state, input.light), spoilt_debounce);
    if (reads) look_for_noise(limits, state, input, out);
    // Only on the way to a lock: a settled gyro has cheaper tests.
    const bool is_whole = reads && !out.withheld && !input.settled;
    if (!is_whole) state.has_end = false;
    if (is_whole && (jumps(limits, state, input, out) || (input.closed && fades(limits, input, before))))
        state.is_unbalanced = true;
    // After a contradiction the beams must first be seen to be balanced.
    if (out.contradicted) state.is_unbalanced = true;
    if (reads) {
        balance(limits, state, input, out);
    } else {
        state.has_last = false;
        state.n_side = 0;
        state.was_dark = watches && input.settled && !input.read.two_way;
    }
    if (out.stuck) input.read.usable = out.has_mean_square = false;
    return out;
}

}  // namespace zlg::core
