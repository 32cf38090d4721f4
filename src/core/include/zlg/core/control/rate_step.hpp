#pragma once
// A lasting step of the rate after a steady stretch. Within one mode an outer field and a rotation look alike; a switch tells
// them apart, so that a schedule that knows of the step can switch early (switch_schedule.hpp).

#include <cstdint>

namespace zlg::core {

struct RateStepConfig {
    std::int32_t block_halves = 0;  // over which counts are summed, even, 2..2^20; 0: nothing is looked for
    double min_counts = 2.0;        // of a step in a block, at least, 1..1e9: a block has two roundings
};

enum class RateStepFault : unsigned char { none, block_halves, min_counts };

[[nodiscard]] constexpr RateStepFault check(const RateStepConfig& c) noexcept {
    const bool is_off = c.block_halves == 0;
    if (!is_off && !(c.block_halves >= 2 && c.block_halves <= (1 << 20) && c.block_halves % 2 == 0))
        return RateStepFault::block_halves;
    return c.min_counts >= 1.0 && c.min_counts <= 1e9 ? RateStepFault::none : RateStepFault::min_counts;
}

struct RateStepState {
    std::int32_t n_halves = 0;  // of the present block
    std::int64_t counts = 0;
    std::int32_t n_level = 0;     // blocks of this segment in `level`, up to 16
    double level_counts = 0.0;    // mean of the blocks before the step
    bool has_held = false;        // the last block agreed with the level, and is not yet in it:
    double held_counts = 0.0;     // a step may have begun in it
    std::int32_t n_scatter = 0;   // blocks in `scatter`, of all segments, up to 16
    double scatter_counts = 0.0;  // mean size of a block less the level
    std::int32_t n_away = 0;      // blocks in a row that are away from the level on one side, negative on the lower one
    bool stepped = false;
    double most_counts = 0.0;  // that a block was away since then

    friend constexpr bool operator==(const RateStepState&, const RateStepState&) = default;
};

struct RateStepInput {
    bool is_second = false;  // half of its tick
    bool closed = true;      // an open loop ends the segment
    bool good = true;        // the counts are those of this half
    std::int64_t counts = 0;
};

// Advance by one half-period; returns whether the rate has stepped in this segment and is still away.
//
// The mean of the blocks of a segment is its level. The rate has stepped where two blocks in a row are away from it on the same
// side by more than
//
//   limit = max(min_counts, 6 scatter)
//
// scatter the mean size of what blocks were away before, over 16 of them and over all segments: a base that moves makes no step
// until it does more than it did. Nothing is judged before two blocks of a segment are in its level, and four in the scatter.
// A step is over when a block is back within half of the limit; it was motion then, and counts as scatter.
//
// config  passed `check`.
// errors  a half with more than 2^32 counts, or that is not good, begins the present block anew.
// cost    an addition a half; some 60 instructions at the end of a block.
[[nodiscard]] bool step(const RateStepConfig& config, RateStepState& state, const RateStepInput& input) noexcept;

}  // namespace zlg::core
