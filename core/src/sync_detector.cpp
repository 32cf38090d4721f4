#include <zlg/core/sync_detector.hpp>

#include <zlg/core/maths.hpp>

#include "pair.hpp"

namespace zlg::core {
namespace {

constexpr std::int32_t agreements_learnt = 4;
constexpr std::size_t most_samples = 64;

bool well_formed(const SyncDetectorInput& in) noexcept {
    const std::size_t n = in.light_a.size();
    return n > 0 && n <= most_samples && (in.light_b.empty() || in.light_b.size() == n);
}

// Sums of samples and of their squares, each in the order of the samples.
struct Moments {
    Pair sums{};

    void add(double x) noexcept { sums += Pair{x, x * x}; }
    void add(Pair x) noexcept {
        const Pair square = x * x;
        sums += Pair{x[0], square[0]};
        sums += Pair{x[1], square[1]};
    }
};

struct Extremes {
    Pair lowest;
    Pair highest;

    explicit Extremes(float first) noexcept
        : lowest{static_cast<double>(first), static_cast<double>(first)}, highest{lowest} {}

    void take(Pair x) noexcept {
        lowest = lowest < x ? lowest : x;
        highest = highest > x ? highest : x;
    }
};

double lower(Pair x) noexcept { return x[0] < x[1] ? x[0] : x[1]; }
double higher(Pair x) noexcept { return x[0] > x[1] ? x[0] : x[1]; }

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

void deliver(const Moments& m, const SyncDetectorInput& in, SyncDetectorOutput& out) noexcept {
    const double n = static_cast<double>(in.light_a.size());
    out.detuning = Wavelengths{in.sign < 0 ? -m.sums[0] / n : m.sums[0] / n};
    out.mean_sq_lambda2 = m.sums[1] / n;
    out.usable = true;
}

// What both beams tell of one half: of dark or damaged ones too, where no detuning will be made of it.
struct BothBeams {
    double weakest = 0.0;  // sample of either beam
    double light = 0.0;    // finite exactly where every sample is: 64 floats cannot overflow a double
    Moments dl_lambda{};
};

BothBeams survey(const SyncDetectorConfig& c, const SyncDetectorInput& in) noexcept {
    const float* const a = in.light_a.data();
    const float* const b = in.light_b.data();
    const std::size_t n = in.light_a.size();
    const auto detuning_lambda = [&c](auto x, auto y) { return (x - y) / (x + y) / c.discriminator_per_lambda; };
    Pair weakest = Pair{static_cast<double>(a[0]), static_cast<double>(b[0])};
    double sum_a = 0.0;
    double sum_b = 0.0;
    BothBeams both;
    std::size_t k = 0;
    for (; k + 1 < n; k += 2) {
        const Pair x = load(a + k);
        const Pair y = load(b + k);
        weakest = weakest < x ? weakest : x;
        weakest = weakest < y ? weakest : y;
        sum_a += x[0];
        sum_a += x[1];
        sum_b += y[0];
        sum_b += y[1];
        both.dl_lambda.add(detuning_lambda(x, y));
    }
    if (k < n) {
        const Pair last{static_cast<double>(a[k]), static_cast<double>(b[k])};
        weakest = weakest < last ? weakest : last;
        sum_a += last[0];
        sum_b += last[1];
        both.dl_lambda.add(detuning_lambda(last[0], last[1]));
    }
    both.weakest = lower(weakest);
    both.light = sum_a / static_cast<double>(n) + sum_b / static_cast<double>(n);
    return both;
}

void detect_both(const SyncDetectorConfig& c, SyncDetectorState& s, const SyncDetectorInput& in,
                 SyncDetectorOutput& out) noexcept {
    const BothBeams both = survey(c, in);
    out.readable = is_finite(both.light);
    if (!out.readable) return;
    const double share = 0.5 * c.dark_fraction;
    out.light = both.light;

    const bool balanced = out.light > c.level_min && both.weakest > share * out.light;
    out.two_way = balanced && both.weakest > share * s.both.level;
    if (balanced) observe(c, s.both, out.light, in.settled && out.two_way, 2.0 * c.level_ticks);
    if (out.two_way) deliver(both.dl_lambda, in, out);
}

struct Extent {
    double lowest;
    double highest;
    double mean;  // finite exactly where every sample is
};

Extent extent(std::span<const float> samples) noexcept {
    const float* const sample = samples.data();
    const std::size_t n = samples.size();
    Extremes extremes{sample[0]};
    double sum = 0.0;
    std::size_t k = 0;
    for (; k + 1 < n; k += 2) {
        const Pair x = load(sample + k);
        extremes.take(x);
        sum += x[0];
        sum += x[1];
    }
    if (k < n) {
        const double last = static_cast<double>(sample[k]);
        extremes.take(Pair{last, last});
        sum += last;
    }
    return {lower(extremes.lowest), higher(extremes.highest), sum / static_cast<double>(n)};
}

void demodulate_single(const SyncDetectorConfig& c, const SyncDetectorInput& in, double level,
                       SyncDetectorOutput& out) noexcept {
    const float* const light = in.light_a.data();
    const std::size_t n = in.light_a.size();
    const auto detuning_lambda = [&](auto x) { return (x - level) / level / c.discriminator_per_lambda; };
    Moments dl_lambda;
    std::size_t k = 0;
    for (; k + 1 < n; k += 2) dl_lambda.add(detuning_lambda(load(light + k)));
    if (k < n) dl_lambda.add(detuning_lambda(static_cast<double>(light[k])));
    deliver(dl_lambda, in, out);
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
    if (out.two_way && level > 0.0) demodulate_single(c, in, level, out);

    const auto sign = static_cast<std::int8_t>(in.sign < 0 ? -1 : 1);
    if (s.sign_a == -sign) {
        const double light = 0.5 * (a.mean + s.mean_a);
        if (light > c.level_min) observe(c, s.single, light, in.settled && out.two_way, c.level_ticks);
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
