#include <zlg/core/compensation/motion_moments.hpp>

#include <zlg/core/common/maths.hpp>

namespace zlg::core {
namespace {

// Windows of a block: half a second of 5 ms ticks. The work of (3) comes once a block, so this sets its share in a
// tick.
constexpr int block_windows = 100;

// N of (3). An exponential memory of N windows scatters as much as a sliding one of 2 N, so these stand for sliding
// sums over 1000 and 6000 ticks: a short one for motion that changes, a long one for steady motion. The choice between
// the two, score by score, is what the trials on recorded motion asked for (results: docs/accuracy_campaign.md, (e)).
constexpr std::array<double, 2> memory_windows{500.0, 3000.0};

// Blocks over which the level is averaged: 10 s of 5 ms ticks. By trial on bench/accuracy.
constexpr double level_blocks = 20.0;

// The loops of every tick have their length at compile time.
template <unsigned stride>
void shift(Window& recent) noexcept {
#pragma GCC unroll 38
    for (unsigned k = 0; k + stride < stride * window_ticks; ++k) recent[k] = recent[k + stride];
}

template <unsigned length>
void add_products(double factor, const Window& x, Window& row) noexcept {
#pragma GCC unroll 19
    for (unsigned b = 0; b < length; ++b) row[b] += factor * x[b];
}

// Append the samples of a tick, less the level, to the recent ones.
void shift_in(const MotionMomentsConfig& config, MotionMomentsState& state, const MotionTick& tick) noexcept {
    const auto window = static_cast<unsigned>(window_of(config));
    const auto stride = static_cast<unsigned>(samples_per_tick(config));
    if (config.halves)
        shift<2>(state.recent);
    else
        shift<1>(state.recent);
    const double level = state.level / static_cast<double>(stride);
    state.recent[window - stride] = tick.first - level;
    if (stride == 2) state.recent[window - 1] = tick.second - level;
    state.n_recent += static_cast<int>(stride);
    if (state.n_recent > static_cast<int>(window)) state.n_recent = static_cast<int>(window);
}

// (1) for the first s rows of the block's matrix. Row 1 begins on the diagonal: element (1, 0) is (0, 1), of row 0.
void add_window(const MotionMomentsConfig& config, MotionMomentsState& state) noexcept {
    MotionBlock& block = state.block;
    const Window& x = state.recent;
    const auto window = static_cast<unsigned>(window_of(config));
    if (block.n_windows == 0) {
        block.first = x;
        block.with_phase = state.with_phase;
    }
    if (config.halves) {
        add_products<max_window>(x[0], x, block.row[0]);
        const double first = block.row[1][0];
        add_products<max_window>(x[1], x, block.row[1]);
        block.row[1][0] = first;
    } else {
        add_products<window_ticks>(x[0], x, block.row[0]);
    }
    state.block_sum += config.halves ? x[window - 1] + x[window - 2] : x[window - 1];
    ++block.n_windows;
}

// (2): row r of the block's matrix from row r - s, in place.
void unfold(const MotionMomentsConfig& config, const Window& last, MotionBlock& block, int r) noexcept {
    const int stride = samples_per_tick(config);
    const auto window = static_cast<unsigned>(window_of(config));
    Window& row = block.row[static_cast<unsigned>(r % stride)];
    const auto to = static_cast<unsigned>(r);
    const auto s = static_cast<unsigned>(stride);
#pragma GCC unroll 4
    for (unsigned b = window - 1; b >= to; --b)
        row[b] = row[b - s] + last[to] * last[b] - block.first[to - s] * block.first[b - s];
}

// (3) for row r.
void add_row(int window, int r, const Window& row, const std::array<double, 2>& keep,
             MotionMomentsState& state) noexcept {
    const int start = moment_index(window, r, 0);
    double* const fast = state.moments[fast_memory].sum.data() + start;
    double* const slow = state.moments[slow_memory].sum.data() + start;
#pragma GCC unroll 4
    for (int b = r; b < window; ++b) {
        const double x = row[static_cast<unsigned>(b)];
        fast[b] = keep[fast_memory] * fast[b] + x;
        slow[b] = keep[slow_memory] * slow[b] + x;
    }
}

// The memories hold readings without the place within the count, and the block has it.
bool begins_anew(const MotionMomentsState& state) noexcept {
    const Moments& learnt = state.moments[fast_memory];
    return state.block.with_phase && learnt.n_windows > 0.0 && learnt.by_phase < 1.0;
}

// Mean square about the window's mean: trace/n less the mean of all elements, x^T (I - 1 1^T/n) x/n averaged over
// windows.
double scatter_of(const MotionMomentsConfig& config, const Moments& moments) noexcept {
    const int window = window_of(config);
    const double* element = moments.sum.data();
    double trace = 0.0;
    double beside = 0.0;
    for (int a = 0; a < window; ++a) {
        trace += *element++;
        for (int b = a + 1; b < window; ++b) beside += *element++;
    }
    // Of half-ticks: a tick has twice the angle of its halves, four times their square.
    const double of_samples = trace / window - (trace + 2.0 * beside) / (window * window);
    const double stride = samples_per_tick(config);
    return stride * stride * (of_samples > 0.0 ? of_samples : 0.0) / moments.n_windows;
}

// Unfold the block, which ends with the recent samples, and add it to both memories, or put it in their place.
void fold(const MotionMomentsConfig& config, MotionMomentsState& state) noexcept {
    const int stride = samples_per_tick(config);
    MotionBlock& block = state.block;
    std::array<double, 2> keep{};
    const bool anew = begins_anew(state);
    for (unsigned m = 0; m < keep.size() && !anew; ++m) keep[m] = maths::exp(-block.n_windows / memory_windows[m]);
    for (int r = 0; r < window_of(config); ++r) {
        if (r >= stride) unfold(config, state.recent, block, r);
        add_row(window_of(config), r, block.row[static_cast<unsigned>(r % stride)], keep, state);
    }
    for (unsigned m = 0; m < keep.size(); ++m) {
        Moments& moments = state.moments[m];
        const double before = keep[m] * moments.n_windows;
        moments.n_windows = before + block.n_windows;
        moments.by_phase = (before * moments.by_phase + (block.with_phase ? block.n_windows : 0)) / moments.n_windows;
        moments.scatter = scatter_of(config, moments);
    }
    state.n_folded = anew ? 1 : (state.n_folded + 1) % 0x10000;
}

// Windows of one kind do not go into memories of the other where they are too few to stand alone.
bool is_left_out(const MotionMomentsState& state) noexcept {
    const MotionBlock& block = state.block;
    if (block.with_phase) return begins_anew(state) && block.n_windows < min_windows;
    return state.moments[fast_memory].by_phase > 0.0 && block.n_windows < block_windows;
}

// The block is complete: fold it, and move the level by its mean. True where the memories hold readings by phase alone from
// now on, and did not before.
bool close_block(const MotionMomentsConfig& config, MotionMomentsState& state) noexcept {
    if (is_left_out(state)) {
        state.block = MotionBlock{};
        state.block_sum = 0.0;
        return false;
    }
    const Moments& learnt = state.moments[fast_memory];
    const bool by_counts = learnt.by_phase < 1.0;
    fold(config, state);
    const double n = state.block.n_windows;
    if (state.n_levels < level_blocks) state.n_levels += n / block_windows;
    const double part = n / block_windows / (state.n_levels > 1.0 ? state.n_levels : 1.0);
    const double moved = part * (state.block_sum / n);
    state.level += moved;
    state.block = MotionBlock{};
    state.block_sum = 0.0;
    // The samples at hand move to the new level.
    const double each = moved / samples_per_tick(config);
    for (unsigned k = 0; k < static_cast<unsigned>(window_of(config)); ++k) state.recent[k] -= each;
    return by_counts && learnt.by_phase == 1.0;
}

// The tick that follows is no neighbour of the last one.
bool end_block(const MotionMomentsConfig& config, MotionMomentsState& state) noexcept {
    if (state.n_recent == 0) return false;
    state.n_recent = 0;
    return state.block.n_windows > 0 && close_block(config, state);
}

// No gyro turns that far in a tick. Below the limit sums of squares stay finite.
bool is_possible(double x) noexcept { return x > -1e15 && x < 1e15; }

}  // namespace

MotionMomentsOutput step(const MotionMomentsConfig& config, MotionMomentsState& state,
                         const MotionTick& tick) noexcept {
    MotionMomentsOutput out;
    const bool usable = tick.usable && is_possible(tick.first) && is_possible(tick.second);
    if (!usable) out.began_by_phase = end_block(config, state);
    if (!usable) return out;
    if (state.block.n_windows > 0 && state.block.with_phase != state.with_phase)
        out.began_by_phase = close_block(config, state);
    if (state.n_levels == 0.0 && state.n_recent == 0)
        state.level = config.halves ? tick.first + tick.second : tick.first;
    shift_in(config, state, tick);
    if (state.n_recent < window_of(config)) return out;
    out.has_window = true;
    add_window(config, state);
    if (state.block.n_windows == block_windows && close_block(config, state)) out.began_by_phase = true;
    return out;
}

double moment(const MotionMomentsConfig& config, const Moments& moments, int a, int b) noexcept {
    if (!(moments.n_windows > 0.0)) return 0.0;
    return moments.sum[static_cast<unsigned>(moment_index(window_of(config), a, b))] / moments.n_windows;
}

}  // namespace zlg::core
