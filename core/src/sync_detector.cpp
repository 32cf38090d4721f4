#include <zlg/core/sync_detector.hpp>

#include <zlg/core/maths.hpp>

namespace zlg::core {
namespace {

constexpr std::int32_t agreements_learnt = 4;
constexpr std::size_t most_samples = 64;

bool readable(const SyncDetectorInput& in) noexcept {
    const std::size_t n = in.light_a.size();
    if (n == 0 || n > most_samples) return false;
    if (!in.light_b.empty() && in.light_b.size() != n) return false;
    for (const float x : in.light_a) {
        if (!is_finite(static_cast<double>(x))) return false;
    }
    for (const float x : in.light_b) {
        if (!is_finite(static_cast<double>(x))) return false;
    }
    return true;
}

struct Extent {
    double lowest;
    double highest;
    double mean;
};

Extent extent(std::span<const float> samples) noexcept {
    const double first = static_cast<double>(samples.front());
    Extent e{.lowest = first, .highest = first, .mean = 0.0};
    for (const float sample : samples) {
        const double x = static_cast<double>(sample);
        if (x < e.lowest) e.lowest = x;
        if (x > e.highest) e.highest = x;
        e.mean += x;
    }
    e.mean /= static_cast<double>(samples.size());
    return e;
}

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

struct Moments {
    double sum = 0.0;
    double sum_sq = 0.0;

    void add(double x) noexcept {
        sum += x;
        sum_sq += x * x;
    }
};

void deliver(const Moments& m, const SyncDetectorInput& in, SyncDetectorOutput& out) noexcept {
    const double n = static_cast<double>(in.light_a.size());
    out.detuning = Wavelengths{in.sign < 0 ? -m.sum / n : m.sum / n};
    out.mean_sq_lambda2 = m.sum_sq / n;
    out.usable = true;
}

// Two-way light: no sum is zero.
void demodulate_both(const SyncDetectorConfig& c, const SyncDetectorInput& in, SyncDetectorOutput& out) noexcept {
    Moments dl_lambda;
    for (std::size_t k = 0; k < in.light_a.size(); ++k) {
        const double a = static_cast<double>(in.light_a[k]);
        const double b = static_cast<double>(in.light_b[k]);
        dl_lambda.add((a - b) / (a + b) / c.discriminator_per_lambda);
    }
    deliver(dl_lambda, in, out);
}

void demodulate_single(const SyncDetectorConfig& c, const SyncDetectorInput& in, double level,
                       SyncDetectorOutput& out) noexcept {
    Moments dl_lambda;
    for (const float x : in.light_a) {
        dl_lambda.add((static_cast<double>(x) - level) / level / c.discriminator_per_lambda);
    }
    deliver(dl_lambda, in, out);
}

void detect_both(const SyncDetectorConfig& c, SyncDetectorState& s, const SyncDetectorInput& in,
                 SyncDetectorOutput& out) noexcept {
    const Extent a = extent(in.light_a);
    const Extent b = extent(in.light_b);
    const double weakest = a.lowest < b.lowest ? a.lowest : b.lowest;
    const double share = 0.5 * c.dark_fraction;
    out.light = a.mean + b.mean;

    const bool balanced = out.light > c.level_min && weakest > share * out.light;
    out.two_way = balanced && weakest > share * s.both.level;
    if (balanced) observe(c, s.both, out.light, in.settled && out.two_way, 2.0 * c.level_ticks);
    if (out.two_way) demodulate_both(c, in, out);
}

void detect_single(const SyncDetectorConfig& c, SyncDetectorState& s, const SyncDetectorInput& in,
                   SyncDetectorOutput& out) noexcept {
    const Extent a = extent(in.light_a);
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
    out.readable = readable(input);
    if (!out.readable) {
        state.sign_a = 0;
        return out;
    }
    if (input.light_b.empty()) {
        detect_single(config, state, input, out);
    } else {
        detect_both(config, state, input, out);
    }
    return out;
}

}  // namespace zlg::core
