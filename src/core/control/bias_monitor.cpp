#include <zlg/core/control/bias_monitor.hpp>

#include <zlg/core/common/as_double.hpp>

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
constexpr std::int64_t max_exact_counts = std::int64_t{1} << 53;

// The static lock-in zone of a gyro whose threshold is half a hundredth of its bias, several times over.
constexpr double near_rate_ratio = 0.03;

// Of b out of its band, but steady, before it is the new level. What was learnt of a faulty bias is given up sooner.
constexpr std::int32_t new_level_halves = 400;
constexpr std::int32_t better_level_halves = 32;

// A bias that has changed for good, or that was learnt while it was faulty.
void learn_anew(const BiasMonitorConfig& c, BiasMonitorState& s, double b) noexcept {
    if (!(b > 0.25 * c.presumed_counts && b > 0.5 * min_bias_counts)) {
        s.n_steady = 0;
        return;
    }
    const bool agrees = size(b - s.steady_counts) < s.steady_counts / 12.0;
    s.n_steady = agrees ? s.n_steady + 1 : 1;
    s.steady_counts = agrees ? s.steady_counts + (b - s.steady_counts) / s.n_steady : b;
    const double off_counts = size(s.bias_counts - c.presumed_counts);
    const bool better = size(s.steady_counts - c.presumed_counts) < 0.5 * off_counts;
    if (s.n_steady < (better ? better_level_halves : new_level_halves)) return;
    s.bias_counts = s.steady_counts;
    s.n_steady = 0;
}

// Learn from any beat of the right sign, then follow b while it is in its band.
void learn(const BiasMonitorConfig& c, BiasMonitorState& s, double b, bool in_band) noexcept {
    if (s.n_learnt >= bias_learning_halves) {
        if (!in_band) return learn_anew(c, s, b);
        s.n_steady = 0;
        s.bias_counts += bias_followed * (b - s.bias_counts);
        return;
    }
    if (!(b > 0.5 * min_bias_counts)) return;
    const bool agrees = size(b - s.bias_counts) < 0.25 * s.bias_counts;
    s.n_learnt = agrees ? s.n_learnt + 1 : 1;
    s.bias_counts = agrees ? s.bias_counts + (b - s.bias_counts) / s.n_learnt : b;
}

bool follows(const BiasMonitorState& s, const BiasMonitorInput& in) noexcept {
    return s.n_known > 0 && in.beat_sign != s.beat_sign;
}

void remember(BiasMonitorState& s, const BiasMonitorInput& in, bool follows) noexcept {
    if (!follows) s.n_known = 0;
    count_up(s.n_known);
    s.beat_sign = in.beat_sign;
    s.counts_long_before = s.counts_before;
    s.counts_before = s.counts;
    s.counts = in.counts;
}

void judge(const BiasMonitorConfig& c, BiasMonitorState& s, const BiasMonitorInput& in,
           BiasMonitorOutput& out) noexcept {
    const double twice_b = as_double(in.counts - s.counts) * in.beat_sign;
    const double bias = s.bias_counts;
    out.judged = s.n_learnt >= bias_learning_halves;
    if (out.judged) {
        const bool smooth = in.settled && s.n_known >= 3;
        const double change = smooth ? size(as_double(s.counts - s.counts_long_before)) : 0.0;
        const double fine = bias / 6.0 + change;
        const double tolerance = smooth && fine < bias ? fine : bias;
        out.in_band = size(twice_b - 2.0 * bias) <= tolerance;
        // More than that is a wrong reading.
        const bool reversed = !out.in_band && size(twice_b + 2.0 * bias) < bias;
        s.n_reversed = reversed ? s.n_reversed + (s.n_reversed < reversed_debounce) : 0;
        out.reversed = s.n_reversed >= reversed_debounce;
        out.deficit_ratio = smooth ? 1.0 - 0.5 * twice_b / bias : 0.0;
        out.lost = !out.in_band && size(twice_b) < bias;
        out.near_rate = out.in_band && size(as_double(in.counts)) < near_rate_ratio * bias;
    } else {
        // What was never there is not learnt.
        out.lost = in.settled && size(twice_b) < 0.25 * c.presumed_counts;
    }
    if (in.settled) learn(c, s, 0.5 * twice_b, out.in_band);
}

}  // namespace

BiasMonitorOutput step(const BiasMonitorConfig& config, BiasMonitorState& state,
                       const BiasMonitorInput& input) noexcept {
    BiasMonitorOutput out;
    if (!(config.presumed_counts >= min_bias_counts)) return out;
    if (!input.counted || input.counts > max_exact_counts || input.counts < -max_exact_counts) {
        state.n_known = 0;
        return out;
    }
    const bool pair = follows(state, input);
    if (pair) {
        judge(config, state, input, out);
    } else {
        state.n_reversed = 0;
    }
    remember(state, input, pair);
    return out;
}

}  // namespace zlg::core
