#include <zlg/core/control/fringe_readout.hpp>

#include <zlg/core/common/maths.hpp>

#include "common/bounds.hpp"

namespace zlg::core {
namespace {

// A turn in the unit of the arithmetic, so that a quarter has 65536 parts.
constexpr std::int32_t quarter_parts = 1 << 16;
constexpr std::int32_t turn_parts = 4 * quarter_parts;

// Beyond the phase's own quarter, 1/2 from its middle, the comparators may be off by 3/4 of the next one.
constexpr std::int32_t max_off_parts = quarter_parts + quarter_parts / 4;

constexpr double four_pi = 12.566370614359172;

// Equal samples in a row, while the other photodiode moves by a tenth of the amplitude, from which on one is stuck. By
// chance two come in 2 of 10^7 samples of a converter of 12 bits.
constexpr std::int32_t stuck_samples = 2;
constexpr double moved = 0.1;

// The square of the radius may be off by so much, or by six standard deviations of what the ellipse was learnt from.
constexpr double least_gate = 0.1;

// Noise beyond three times the presumed one, and beyond 0.004 turns, is a fault.
constexpr double least_noise_turns = 0.004;
constexpr double most_square = 0.04;  // that one sample counts: a single one off the circle is no noise
constexpr double quality_samples = 16.0;

// The amplitude is followed: with a memory of 4 samples while the gyro settles, of 64 afterwards.
constexpr double settling_samples = 4.0;
constexpr double settled_samples = 64.0;
constexpr double least_level = 0.01;
constexpr double most_level = 4.0;

// Samples in a row that show another offset before it is used: rare in a settled gyro, usual after a gap, in which the
// counter loses quarters.
constexpr std::int32_t offset_debounce = 8;
constexpr std::int32_t offset_debounce_after_gap = 2;
constexpr std::int32_t forgets_after_halves = 1024;  // 2.6 s without a fringe: the photodiodes have changed

// Blocks of 128 samples, evenly over the octants. Of d only the whole quarters count, one with the probability of four
// times the skew, for the rest is the place in the quarter, which repeats at rest: a block has a skew of 0.003 turns to
// 1/4 sqrt(0.012/128) = 0.0024. At rest the shifted edges bring the same places at a border several times: up to four
// times that, so that of n blocks this much over sqrt(n) is not trusted.
constexpr double block_turns = 0.01;
constexpr std::int32_t skew_blocks = 64;
constexpr std::int32_t min_skew_blocks = 16;

// A phase that creeps fills each octant right behind its border, where the comparators still lag: such a block takes
// longer than twice its samples.
constexpr std::int32_t most_skew_halves = 2 * samples_a_bin * ellipse_bins;

// A photodiode stands still while the other one moves, or both do while the comparators change.
bool is_stuck(const FringeReadoutConfig& c, FringeReadoutState& s, const FringeReadoutInput& in) noexcept {
    const double least = moved * c.amplitude;
    const bool same_cosine = in.c == s.last_cosine;
    const bool same_sine = in.s == s.last_sine;
    const bool moves_cosine = size(static_cast<double>(in.c) - static_cast<double>(s.last_cosine)) > least;
    const bool moves_sine = size(static_cast<double>(in.s) - static_cast<double>(s.last_sine)) > least;
    if (!same_cosine) s.n_same_cosine = 0;
    if (!same_sine) s.n_same_sine = 0;
    if (same_cosine && moves_sine) count_up(s.n_same_cosine);
    if (same_sine && moves_cosine) count_up(s.n_same_sine);
    s.frozen = same_cosine && same_sine && (s.frozen || in.quarter != s.last_quarter);
    s.last_cosine = in.c;
    s.last_sine = in.s;
    s.last_quarter = in.quarter;
    return s.frozen || s.n_same_cosine >= stuck_samples || s.n_same_sine >= stuck_samples;
}

bool is_readable(const FringeReadoutConfig& c, const FringeReadoutInput& in) noexcept {
    return size(static_cast<double>(in.c)) < c.limit && size(static_cast<double>(in.s)) < c.limit;
}

void judge_noise(const FringeReadoutConfig& c, FringeReadoutState& s, double off) noexcept {
    const double square = off * off < most_square ? off * off : most_square;
    s.mean_square += (square - s.mean_square) / quality_samples;
    const double most = four_pi * (3.0 * c.noise_turns > least_noise_turns ? 3.0 * c.noise_turns : least_noise_turns);
    if (s.mean_square > most * most) s.noisy = true;
    if (s.mean_square < 0.5 * most * most) s.noisy = false;
}

// Whether the sample lies on the circle. In a settled gyro that also judges noise and amplitude.
bool is_on_circle(const FringeReadoutConfig& c, FringeReadoutState& s, double square, bool settled) noexcept {
    if (!(square > least_level && square < most_level)) {
        if (settled) judge_noise(c, s, 1.0);
        return false;
    }
    if (!settled) {
        s.level += (square - s.level) / settling_samples;
        return true;
    }
    const double off = square / s.level - 1.0;
    const double usual = 6.0 * four_pi * s.ellipse.noise_turns;
    const bool good = size(off) <= (usual > least_gate ? usual : least_gate);
    judge_noise(c, s, off);
    s.level += (square - s.level) / settled_samples;
    return good;
}

// d, in parts.
std::int32_t off_quarter(const FringeReadoutState& s, const QuadratureSample& p, std::uint32_t quarter) noexcept {
    const auto phase = static_cast<std::int32_t>(turns_of(p.c, p.s) * turn_parts);
    const std::int32_t middle =
        (static_cast<std::int32_t>(quarter & 3u) + s.offset_quarters) * quarter_parts + quarter_parts / 2;
    return ((phase - middle + turn_parts / 2) & (turn_parts - 1)) - turn_parts / 2;
}

bool is_beside(std::int32_t off) noexcept { return off <= max_off_parts && off >= -max_off_parts; }

// The counter may have lost quarters where it counted no beat; then all samples are off by the same. True where the
// offset is another one now.
bool follow_offset(FringeReadoutState& s, std::int32_t off, bool settled) noexcept {
    const std::int32_t quarters = ((off + quarter_parts / 2) >> 16) & 3;
    s.n_other = quarters == s.other_quarters ? s.n_other + 1 : 1;
    s.other_quarters = quarters;
    if (s.n_other < (settled ? offset_debounce : offset_debounce_after_gap)) return false;
    s.offset_quarters = (s.offset_quarters + quarters) & 3;
    s.n_other = 0;
    return true;
}

// The sample as it would be at the amplitude of the map.
QuadratureSample at_usual_amplitude(const FringeReadoutState& s, const QuadratureSample& x) noexcept {
    if (!s.ellipse.learnt) return x;
    const double part = 1.0 / square_root(s.level);
    const EllipseMap& m = s.ellipse.map;
    return {m.c0 + part * (x.c - m.c0), m.s0 + part * (x.s - m.s0)};
}

// What d is in the sense of the beat, on average.
double usual_off_turns(const FringeReadoutConfig& c, const FringeReadoutInput& in) noexcept {
    const double against_counts = -0.5 * in.sign * in.rotation_counts;
    if (!(against_counts > 0.0)) return c.lag_turns;
    const double back_turns = c.turned_back_turns * against_counts * against_counts;
    return back_turns < 2.0 * c.lag_turns ? c.lag_turns - back_turns : -c.lag_turns;
}

void learn(const FringeReadoutConfig& c, FringeReadoutState& s, const QuadratureSample& x, const FringeReadoutInput& in,
           std::int32_t off) noexcept {
    const bool was_learnt = s.ellipse.learnt;
    const std::int32_t halves = s.ellipse.n_halves + 1;
    const EllipseLearning done = learn(s.ellipse, at_usual_amplitude(s, x), in.sign);
    if (done.is_first) s.skew_sum_turns = 0.0;
    if (done.taken) s.skew_sum_turns += 0.25 * in.sign * ((off + quarter_parts / 2) >> 16) - usual_off_turns(c, in);
    if (!done.completes) return;
    if (!was_learnt && s.ellipse.learnt) s.level = 1.0;
    const double mean = s.skew_sum_turns / (samples_a_bin * ellipse_bins);
    if (!was_learnt || halves > most_skew_halves) return;
    if (s.n_skews < skew_blocks) ++s.n_skews;
    s.skew_turns += (mean - s.skew_turns) / s.n_skews;
}

bool is_skewed(const FringeReadoutConfig& c, const FringeReadoutState& s) noexcept {
    const double over = size(s.skew_turns) - c.max_skew_turns;
    return s.n_skews >= min_skew_blocks && over > 0.0 && over * over * s.n_skews > block_turns * block_turns;
}

// The skew and the offset of the counter are not theirs, and stay.
void forget_photodiodes(FringeReadoutState& s) noexcept {
    forget(s.ellipse);
    s.level = 1.0;
    s.mean_square = s.skew_sum_turns = 0.0;
    s.noisy = false;
    s.n_unread = 0;
}

// The place in the fringe, and the count from the side that the phase names.
void join(const FringeReadoutConfig& c, std::uint32_t quarter, std::int32_t off, FringeReadoutOutput& out) noexcept {
    const std::int32_t place = quarter_parts / 2 + off +
                               (c.counts_per_turn == 1 ? static_cast<std::int32_t>(quarter & 3u) * quarter_parts : 0);
    const int bits = c.counts_per_turn == 1 ? 18 : 16;
    out.counter += static_cast<std::uint64_t>(static_cast<std::int64_t>(place >> bits));
    out.fringe = static_cast<float>((place & ((1 << bits) - 1)) >> (bits - 16));
}

// Whether there is a phase, with its distance from the middle of the quarter.
bool read(const FringeReadoutConfig& c, FringeReadoutState& s, const FringeReadoutInput& in,
          std::int32_t& off) noexcept {
    if (!is_readable(c, in) || is_stuck(c, s, in)) return false;
    const QuadratureSample x{in.c / c.amplitude, in.s / c.amplitude};
    const QuadratureSample p = on_circle(s.ellipse.map, x);
    const bool learnt = s.ellipse.learnt;
    const bool good = !learnt || is_on_circle(c, s, p.c * p.c + p.s * p.s, in.settled);
    if (!good) return false;
    off = off_quarter(s, p, in.quarter);
    bool agrees = is_beside(off);
    if (agrees) {
        s.n_other = 0;
    } else if (follow_offset(s, off, in.settled)) {
        off = off_quarter(s, p, in.quarter);
        agrees = is_beside(off);
    }
    if (in.settled) learn(c, s, x, in, off);
    return learnt && agrees && !s.noisy;
}

}  // namespace

FringeReadoutOutput step(const FringeReadoutConfig& config, FringeReadoutState& state,
                         const FringeReadoutInput& input) noexcept {
    FringeReadoutOutput out{.counter = input.counter};
    if (!config.reads) return out;
    std::int32_t off = 0;
    if (input.present && read(config, state, input, off)) {
        state.n_unread = 0;
        join(config, input.quarter, off, out);
    } else if (input.present && input.settled && state.ellipse.learnt) {
        count_up(state.n_unread);
        if (state.n_unread >= forgets_after_halves) forget_photodiodes(state);
    }
    // A phase that belongs to another instant than the count is worth less than the count alone; its skew is still
    // watched.
    if (is_skewed(config, state)) return {.counter = input.counter, .skewed = true};
    return out;
}

}  // namespace zlg::core
