#pragma once
// Count and phase of the fringe at one latch, made one: whole fringes and the place within the fringe, 1/65536.
//
// The counter's comparators know the quarter of the turn in which they stand; the phase is taken from the photodiodes
// (ellipse_correction.hpp), known modulo a turn, and is placed within half a turn of the middle of that quarter; beyond
// 5/16 turn the two contradict each other. So the count is that from the side which the phase names, and a count and a
// phase that were latched on either side of a border are never a fringe off:
//
//   d = phase - (quarter + 1/2)/4 - offset,  modulo 1, within +-1/2 turn;   place = turns + (quarter + 1/2)/4 + d
//
// Where the phase cannot be trusted the count is as it was read, and there is no fringe: a sample that is missing, not
// finite, saturated or stuck, that lies off the circle, or that contradicts the quarter; an ellipse that is not learnt;
// noise far beyond what is presumed.
//
// A skew tau between latch and sampling shows in d: the beat turns round at the latch, where its frequency goes from f
// to -f within the edge time t_e, at the rate 2 f/t_e; so the phase is tau^2 f/t_e behind in the sense of the beat that
// ends, 1.2e9 tau^2 turns for the default gyro.
//
// The comparators follow the phase by a lag, in the sense of the beat, so that d has it as its mean. A rotation of r
// turns a second against the beat lets it turn round before the latch: there it has turned back by r^2 t_e/(4 f), up to
// two lags before the comparators follow.

#include <cstdint>

#include <zlg/core/control/ellipse_correction.hpp>

namespace zlg::core {

struct FringeReadoutConfig {
    bool reads = false;
    int counts_per_turn = 1;         // of the beat: 1 or 4
    double amplitude = 1.0;          // presumed, of both photodiodes, 1e-9..1e9, their unit
    double limit = 1e9;              // samples from this size on are saturated, > 0
    double noise_turns = 0.0016;     // presumed, of one phase, rms, 0..0.05
    double lag_turns = 0.0;          // by which the comparators follow the phase, 0..1/8
    double max_skew_turns = 0.003;   // of the phase by the skew, > 0: 1.6 us of the default gyro
    double turned_back_turns = 0.0;  // at the latch, by a rotation of one count a half against the beat, 0..1
};

[[nodiscard]] constexpr bool is_allowed(const FringeReadoutConfig& c) noexcept {
    return (c.counts_per_turn == 1 || c.counts_per_turn == 4) && c.amplitude >= 1e-9 && c.amplitude <= 1e9 &&
           c.limit > 0.0 && c.noise_turns >= 0.0 && c.noise_turns <= 0.05 && c.lag_turns >= 0.0 &&
           c.lag_turns <= 0.125 && c.max_skew_turns > 0.0 && c.turned_back_turns >= 0.0 && c.turned_back_turns <= 1.0;
}

struct FringeReadoutState {
    EllipseCorrectionState ellipse{};
    double level = 1.0;        // mean square of the radius on the map's circle
    double mean_square = 0.0;  // mean of (radius^2/level - 1)^2, in a settled gyro
    bool noisy = false;
    float last_cosine = 0.0f;
    float last_sine = 0.0f;
    std::int32_t n_same_cosine = 0;  // samples in a row that repeat the one before while the other one moves
    std::int32_t n_same_sine = 0;
    std::uint32_t last_quarter = 0;
    bool frozen = false;               // both repeat themselves, and the comparators do not
    std::int32_t offset_quarters = 0;  // of the counter's turn against the phase's
    std::int32_t other_quarters = 0;   // another offset that the last `n_other` samples in a row have shown
    std::int32_t n_other = 0;
    std::int32_t n_unread = 0;    // halves of a settled gyro in a row without a fringe
    double skew_sum_turns = 0.0;  // of the whole quarters in d, in the sense of the beat, over the block
    double skew_turns = 0.0;      // its mean over blocks
    std::int32_t n_skews = 0;     // blocks, up to its memory

    friend constexpr bool operator==(const FringeReadoutState&, const FringeReadoutState&) = default;
};

struct FringeReadoutInput {
    bool present = false;  // both photodiodes were sampled at this latch
    float c = 0.0f;
    float s = 0.0f;
    std::uint32_t quarter = 0;  // of the turn, by the comparators: 0..3
    std::uint64_t counter = 0;
    bool settled = false;          // the beat has its usual amplitude
    int sign = 1;                  // of the beat in the half that ended
    double rotation_counts = 0.0;  // of a tick, about
};

struct FringeReadoutOutput {
    std::uint64_t counter = 0;          // whole counts
    float fringe = __builtin_nanf("");  // place within the count, 0..65535; NaN: not known
    bool skewed = false;                // latch and sampling are farther apart than they may be
};

// Advance by one half-period.
//
// accuracy  of the place 1/65536 and the noise of the photodiodes.
// latency   of a fault: a sample off the circle is not used at all; a photodiode that stands still in its third sample.
//           The ellipse is learnt in 128 samples that cover the circle, 0.4 s of a gyro that turns.
[[nodiscard]] FringeReadoutOutput step(const FringeReadoutConfig& config, FringeReadoutState& state,
                                       const FringeReadoutInput& input) noexcept;

}  // namespace zlg::core
