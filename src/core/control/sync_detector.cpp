#include <zlg/core/control/sync_detector.hpp>

#include <zlg/core/common/maths.hpp>
#include <zlg/core/records.hpp>

#include "common/pair.hpp"

namespace zlg::core {
namespace {

constexpr std::int32_t agreements_learnt = 4;
constexpr std::int32_t faint_learnt = 64;
constexpr double dark_share = 0.1;

bool well_formed(const SyncDetectorInput& in) noexcept {
    const std::size_t n = in.light_a.size();
    return n > 0 && n <= max_light_samples && (in.light_b.empty() || in.light_b.size() == n);
}

// Sums of samples and of their squares: of even and of odd samples apart, on every machine.
struct Moments {
    Pair sums{};
    Pair squares{};

    void add(Pair x) noexcept {
        sums += x;
        squares += x * x;
    }

    [[nodiscard]] double sum() const noexcept { return sums[0] + sums[1]; }
    [[nodiscard]] double sum_of_squares() const noexcept { return squares[0] + squares[1]; }
};

double lower(Pair x) noexcept { return x[0] < x[1] ? x[0] : x[1]; }

// Learn the level from steady light far above it (any light is, before the first time), or follow it.
void observe(const SyncDetectorConfig& c, LightLevel& l, double light, bool follow, double time_constant) noexcept {
    if (!(light > (2.0 - c.dark_fraction) * l.level)) {
        l.n_agree = 0;
        if (follow) l.level += (light - l.level) / time_constant;
        return;
    }
    const bool agrees = l.n_agree > 0 && light < 2.0 * l.candidate && l.candidate < 2.0 * light;
    l.n_agree = agrees ? l.n_agree + 1 : 1;
    l.candidate = light;
    if (l.n_agree < agreements_learnt) return;
    l.level = light;
    l.n_agree = 0;
}

// Light that is too little for its level, but beats.
void learn_faint(LightLevel& l, double light, bool is_faint) noexcept {
    l.n_faint = is_faint ? l.n_faint + 1 : 0;
    if (l.n_faint < faint_learnt) return;
    l.level = light;
    l.n_faint = 0;
}

// per_lambda  the unit of the moments, with the sign of the half where these are not yet those of a detuning.
void deliver(const Moments& m, double per_lambda, std::size_t n, SyncDetectorOutput& out) noexcept {
    const double whole = static_cast<double>(n) * per_lambda;
    out.detuning = Wavelengths{m.sum() / whole};
    out.mean_sq_lambda2 = m.sum_of_squares() / (whole * per_lambda);
    out.usable = true;
}

// The signal of a half turns with its sign.
double signed_slope(const SyncDetectorConfig& c, const SyncDetectorInput& in) noexcept {
    return in.sign < 0 ? -c.discriminator_per_lambda : c.discriminator_per_lambda;
}

// Sample k, and the next one where there is one, through the curve.
template <class Signal>
Moments through_curve(const SyncDetectorConfig& c, const SyncDetectorInput& in, const Signal& signal) noexcept {
    const double per_lambda = signed_slope(c, in);
    const std::size_t n = in.light_a.size();
    const auto detuning_lambda = [&](std::size_t k) {
        return true_detuning(c.curve, signal(k) / per_lambda).detuning_lambda;
    };
    Moments dl_lambda;
    std::size_t k = 0;
    for (; k + 1 < n; k += 2) dl_lambda.add(Pair{detuning_lambda(k), detuning_lambda(k + 1)});
    if (k < n) dl_lambda.add(Pair{detuning_lambda(k), 0.0});
    return dl_lambda;
}

// Statistics of both beams over one half, dark or damaged ones included, from which no detuning follows.
struct BothBeams {
    double weakest = 0.0;  // sample of either beam, where every one is finite
    double light = 0.0;    // finite exactly where every sample is: 128 floats cannot overflow a double
    Moments signal{};      // (A - B)/(A + B)
};

BothBeams survey(const SyncDetectorInput& in) noexcept {
    const float* const a = in.light_a.data();
    const float* const b = in.light_b.data();
    const std::size_t n = in.light_a.size();
    Pair weakest = Pair{static_cast<double>(a[0]), in.weight_b.of(static_cast<double>(b[0]))};
    Pair light{};
    BothBeams both;
    std::size_t k = 0;
#pragma GCC unroll 4
    for (; k + 1 < n; k += 2) {
        const Pair x = load(a + k);
        const Pair y = in.weight_b.of(load(b + k));
        weakest = lesser(weakest, lesser(x, y));
        const Pair sum = x + y;
        light += sum;
        both.signal.add((x - y) / sum);
    }
    if (k < n) {
        const Pair last{static_cast<double>(a[k]), in.weight_b.of(static_cast<double>(b[k]))};
        weakest = lesser(weakest, last);
        const double sum = last[0] + last[1];
        light += Pair{sum, 0.0};
        both.signal.add(Pair{(last[0] - last[1]) / sum, 0.0});
    }
    both.weakest = lower(weakest);
    both.light = (light[0] + light[1]) / static_cast<double>(n);
    return both;
}

void detect_both(const SyncDetectorConfig& c, SyncDetectorState& s, const SyncDetectorInput& in,
                 SyncDetectorOutput& out) noexcept {
    const BothBeams both = survey(in);
    out.readable = is_finite(both.light);
    if (!out.readable) return;
    const double share = 0.5 * c.dark_fraction;
    out.light = both.light;

    const bool balanced = out.light > c.level_min && both.weakest > share * out.light;
    out.two_way = balanced && both.weakest > share * s.both.level;
    out.dark = !(both.weakest > 0.5 * dark_share * s.both.level);
    if (balanced) observe(c, s.both, out.light, in.settled && out.two_way, 2.0 * c.level_ticks);
    learn_faint(s.both, out.light, in.beats && balanced && !out.two_way);
    if (!out.two_way) return;
    out.signal = both.signal.sum() / static_cast<double>(in.light_a.size());
    if (c.curve.n_nodes == 0) {
        deliver(both.signal, signed_slope(c, in), in.light_a.size(), out);
    } else {
        // Two-way light: no sum is zero.
        const auto signal = [&in](std::size_t k) {
            const double a = static_cast<double>(in.light_a[k]);
            const double b = in.weight_b.of(static_cast<double>(in.light_b[k]));
            return (a - b) / (a + b);
        };
        deliver(through_curve(c, in, signal), 1.0, in.light_a.size(), out);
    }
}

struct Extent {
    double lowest;
    double highest;
    double mean;  // finite exactly where every sample is
};

Extent extent(std::span<const float> samples) noexcept {
    const float* const sample = samples.data();
    const std::size_t n = samples.size();
    const double first = static_cast<double>(sample[0]);
    Pair lowest{first, first};
    Pair highest = lowest;
    Pair sum{};
    const auto add = [&](Pair x, Pair to_sum) {
        lowest = lesser(lowest, x);
        highest = greater(highest, x);
        sum += to_sum;
    };
    std::size_t k = 0;
    for (; k + 1 < n; k += 2) add(load(sample + k), load(sample + k));
    const double last = static_cast<double>(sample[n - 1]);
    if (k < n) add(Pair{last, last}, Pair{last, 0.0});
    return {lower(lowest), highest[0] > highest[1] ? highest[0] : highest[1],
            (sum[0] + sum[1]) / static_cast<double>(n)};
}

void demodulate_single(const SyncDetectorConfig& c, const SyncDetectorInput& in, double level,
                       SyncDetectorOutput& out) noexcept {
    const float* const light = in.light_a.data();
    const std::size_t n = in.light_a.size();
    const auto signal = [level](auto x) { return (x - level) / level; };
    if (c.curve.n_nodes > 0) {
        const auto of_sample = [&](std::size_t k) { return signal(static_cast<double>(light[k])); };
        deliver(through_curve(c, in, of_sample), 1.0, n, out);
        return;
    }
    Moments signals;
    std::size_t k = 0;
    for (; k + 1 < n; k += 2) signals.add(signal(load(light + k)));
    if (k < n) signals.add(Pair{signal(static_cast<double>(light[k])), 0.0});
    deliver(signals, signed_slope(c, in), n, out);
}

void detect_single(const SyncDetectorConfig& c, SyncDetectorState& s, const SyncDetectorInput& in,
                   SyncDetectorOutput& out) noexcept {
    const Extent a = extent(in.light_a);
    out.readable = is_finite(a.mean);
    if (!out.readable) return;
    const double level = s.single.level;
    const bool near_level = a.lowest > c.dark_fraction * level && a.highest < (2.0 - c.dark_fraction) * level;
    out.light = a.mean;
    out.two_way = a.mean > c.level_min && (level == 0.0 || near_level);
    out.dark = !(a.lowest > dark_share * level);
    if (out.two_way && level > 0.0) demodulate_single(c, in, level, out);

    const auto sign = static_cast<std::int8_t>(in.sign < 0 ? -1 : 1);
    if (s.sign_a == -sign) {
        const double light = 0.5 * (a.mean + s.mean_a);
        if (light > c.level_min) observe(c, s.single, light, in.settled && out.two_way, c.level_ticks);
        learn_faint(s.single, light, in.beats && light > c.level_min && !out.two_way);
        s.sign_a = 0;
    } else {
        s.mean_a = a.mean;
        s.sign_a = sign;
    }
}

}  // namespace

SyncDetectorOutput step(const SyncDetectorConfig& config, SyncDetectorState& state,
                        const SyncDetectorInput& input) noexcept {
    SyncDetectorOutput out;
    if (well_formed(input)) {
        if (input.light_b.empty())
            detect_single(config, state, input, out);
        else
            detect_both(config, state, input, out);
    }
    if (!out.readable) state.sign_a = 0;
    return out;
}

}  // namespace zlg::core
