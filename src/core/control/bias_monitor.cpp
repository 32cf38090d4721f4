#include <zlg/core/control/bias_monitor.hpp>

#include "common/bounds.hpp"

namespace zlg::core {
namespace {

// Averaging of b: over 32 halves to learn, an exponential of 256 to follow. Its rounding, of up to a count, is then
// well below the band.
constexpr std::int32_t bias_learning_halves = 32;
constexpr double bias_followed = 1.0 / 256.0;

// Two halves out of four can be one disturbance of the counts; four of the other helicity cannot.
constexpr std::int32_t reversed_debounce = 4;

// Differences of larger counts could overflow, and no gyro has them.
constexpr double max_exact_counts = 0x1p53;

// The static lock-in zone of a gyro whose threshold is half a hundredth of its bias, several times over.
constexpr double near_rate_ratio = 0.03;

// Of b out of its band, but steady, before it is the new level. What was learnt of a faulty bias is given up sooner.
constexpr std::int32_t new_level_halves = 400;
constexpr std::int32_t better_level_halves = 32;

// The mean of values that agree with it; one that does not begins it anew.
void average(double& mean, std::int32_t& n, double x, double tolerance) noexcept {
    const bool agrees = size(x - mean) < tolerance;
    n = agrees ? n + 1 : 1;
    mean = agrees ? mean + (x - mean) / n : x;
}

// A bias that has changed for good, or that was learnt while it was faulty.
void learn_anew(const MonitorLimits& c, BiasMonitorState& s, double b) noexcept {
    if (!(b > 0.25 * c.bias_counts && b > 0.5 * min_bias_counts)) {
        s.n_steady = 0;
        return;
    }
    average(s.steady_counts, s.n_steady, b, s.steady_counts / 12.0);
    const double off_counts = size(s.bias_counts - c.bias_counts);
    const bool better = size(s.steady_counts - c.bias_counts) < 0.5 * off_counts;
    if (s.n_steady < (better ? better_level_halves : new_level_halves)) return;
    s.bias_counts = s.steady_counts;
    s.n_steady = 0;
}

// Learn from any beat of the right sign, then follow b while it is in its band.
void learn(const MonitorLimits& c, BiasMonitorState& s, double b, bool in_band) noexcept {
    if (s.n_learnt >= bias_learning_halves) {
        if (!in_band) return learn_anew(c, s, b);
        s.n_steady = 0;
        s.bias_counts += bias_followed * (b - s.bias_counts);
        return;
    }
    if (!(b > 0.5 * min_bias_counts)) return;
    average(s.bias_counts, s.n_learnt, b, 0.25 * s.bias_counts);
}

void remember(BiasMonitorState& s, double counts, std::int8_t beat_sign) noexcept {
    count_up(s.n_known);
    s.beat_sign = beat_sign;
    s.counts_long_before = s.counts_before;
    s.counts_before = s.counts;
    s.counts = counts;
}

void compare(const MonitorLimits& c, BiasMonitorState& s, double counts, std::int8_t beat_sign, bool settled,
             BiasMonitorOutput& out) noexcept {
    const double twice_b = (counts - s.counts) * beat_sign;
    const double bias = s.bias_counts;
    out.judged = s.n_learnt >= bias_learning_halves;
    if (out.judged) {
        const bool smooth = settled && s.n_known >= 3;
        const double change = smooth ? size(s.counts - s.counts_long_before) : 0.0;
        const double fine = bias / 6.0 + change;
        const double tolerance = smooth && fine < bias ? fine : bias;
        out.in_band = size(twice_b - 2.0 * bias) <= tolerance;
        // More than that is a wrong reading.
        const bool reversed = !out.in_band && size(twice_b + 2.0 * bias) < bias;
        out.reversed = debounced(s.n_reversed, reversed, reversed_debounce);
        out.deficit_ratio = smooth ? 1.0 - 0.5 * twice_b / bias : 0.0;
        out.lost = !out.in_band && size(twice_b) < bias;
        out.near_rate = out.in_band && size(counts) < near_rate_ratio * bias;
    } else {
        // What was never there is not learnt.
        out.lost = settled && size(twice_b) < 0.25 * c.bias_counts;
    }
    if (settled) learn(c, s, 0.5 * twice_b, out.in_band);
}

}  // namespace

BiasMonitorOutput step(const MonitorLimits& limits, BiasMonitorState& state, bool counted, double counts,
                       std::int8_t beat_sign, bool settled) noexcept {
    BiasMonitorOutput out;
    if (!(limits.bias_counts >= min_bias_counts)) return out;
    if (!counted || size(counts) > max_exact_counts) {
        state.n_known = 0;
        return out;
    }
    if (state.n_known > 0 && beat_sign != state.beat_sign) {
        compare(limits, state, counts, beat_sign, settled, out);
    } else {
        state.n_known = state.n_reversed = 0;
    }
    remember(state, counts, beat_sign);
    return out;
}

}  // namespace zlg::core
