#include <zlg/core/control/rate_step.hpp>

#include <zlg/core/common/as_double.hpp>

#include "common/bounds.hpp"

namespace zlg::core {
namespace {

// Blocks over which level and scatter are averaged, and how many there must be before a block is judged.
constexpr std::int32_t memory_blocks = 16;
constexpr std::int32_t min_level_blocks = 2;
constexpr std::int32_t min_scatter_blocks = 4;

constexpr double scatter_limit = 6.0;

// Blocks that must be away.
constexpr std::int32_t lasting_blocks = 2;

// No gyro has more counts in a half; the sum of a block stays exact.
constexpr std::int64_t max_rate_counts = std::int64_t{1} << 32;

void include(double x, std::int32_t& n, double& mean) noexcept {
    if (n < memory_blocks) ++n;
    mean += (x - mean) / static_cast<double>(n);
}

void end_segment(RateStepState& s) noexcept { s = {.n_scatter = s.n_scatter, .scatter_counts = s.scatter_counts}; }

double limit_of(const RateStepConfig& c, const RateStepState& s) noexcept {
    const double of_scatter = scatter_limit * s.scatter_counts;
    return of_scatter > c.min_counts ? of_scatter : c.min_counts;
}

bool judges(const RateStepState& s) noexcept {
    return s.n_level >= min_level_blocks && s.n_scatter >= min_scatter_blocks;
}

// A block that agrees is held back by one: the next may show that a step began in it.
void hold(RateStepState& s, double block) noexcept {
    if (s.has_held) include(s.held_counts, s.n_level, s.level_counts);
    s.has_held = true;
    s.held_counts = block;
}

void end_block(const RateStepConfig& c, RateStepState& s, double block) noexcept {
    const double off = block - (s.n_level > 0 ? s.level_counts : block);
    const double limit = limit_of(c, s);
    const bool away = judges(s) && size(off) > limit;
    if (s.stepped) {
        s.stepped = s.n_away > 0 ? off > 0.5 * limit : off < -0.5 * limit;
        if (size(off) > s.most_counts) s.most_counts = size(off);
        if (s.stepped) return;
        include(s.most_counts, s.n_scatter, s.scatter_counts);
        s.most_counts = 0.0;
        s.n_away = 0;
        return hold(s, block);
    }
    // One step is no scatter.
    if (s.n_level > 0) include(size(limited(off, limit)), s.n_scatter, s.scatter_counts);
    if (!away) {
        s.n_away = 0;
        return hold(s, block);
    }
    s.has_held = false;
    const std::int32_t side = off > 0.0 ? 1 : -1;
    s.n_away = s.n_away * side > 0 ? s.n_away + side : side;
    s.stepped = s.n_away * side >= lasting_blocks;
}

}  // namespace

bool step(const RateStepConfig& config, RateStepState& state, const RateStepInput& in) noexcept {
    if (config.block_halves == 0) return false;
    if (!in.closed) {
        end_segment(state);
        return false;
    }
    const bool begins_late = state.n_halves == 0 && in.is_second;
    const bool countable = in.good && in.counts <= max_rate_counts && in.counts >= -max_rate_counts;
    if (!countable || begins_late) {
        state.n_halves = 0;
        state.counts = 0;
        return state.stepped;
    }
    state.counts += in.counts;
    if (++state.n_halves < config.block_halves) return state.stepped;
    const double block = as_double(state.counts);
    state.n_halves = 0;
    state.counts = 0;
    end_block(config, state, block);
    return state.stepped;
}

}  // namespace zlg::core
