#include <zlg/core/compensation/motion_moments.hpp>

#include <zlg/core/common/maths.hpp>

namespace zlg::core {
namespace {

constexpr int block_windows = 100;
constexpr int rows_a_tick = 4;  // of ticks; of half-ticks twice as many

// A gap that begins in the next tick needs the whole moments there: of half-ticks three quarters of the work are then done.
constexpr int rows_ahead = 20;

// An exponential memory has as much scatter as a sliding one of twice the length.
constexpr std::array<double, 2> memory_windows{500.0, 3000.0};

// Blocks over which the level is averaged.
constexpr double level_blocks = 20.0;

// What is done in every tick knows at compile time of what length its loops are.
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

void add_window(const MotionMomentsConfig& config, MotionMomentsState& state) noexcept {
    MotionBlock& block = state.block;
    const Window& x = state.recent;
    const auto window = static_cast<unsigned>(window_of(config));
    if (block.n_windows == 0) block.first = x;
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

// Rows r.. of the block that is folded, from the rows before them.
void unfold(const MotionMomentsConfig& config, MotionBlock& block, int r) noexcept {
    const int stride = samples_per_tick(config);
    const auto window = static_cast<unsigned>(window_of(config));
    Window& row = block.row[static_cast<unsigned>(r % stride)];
    const auto to = static_cast<unsigned>(r);
    const auto s = static_cast<unsigned>(stride);
#pragma GCC unroll 4
    for (unsigned b = window - 1; b >= to; --b)
        row[b] = row[b - s] + block.last[to] * block.last[b] - block.first[to - s] * block.first[b - s];
}

void fold_row(const MotionMomentsConfig& config, MotionMomentsState& state) noexcept {
    const int window = window_of(config);
    const int r = state.folded_rows++;
    MotionBlock& block = state.folding;
    if (r >= samples_per_tick(config)) unfold(config, block, r);
    const Window& row = block.row[static_cast<unsigned>(r % samples_per_tick(config))];
    // Both memories together: the row is then read once.
    const int start = moment_index(window, r, 0);
    double* const fast = state.moments[fast_memory].sum.data() + start;
    double* const slow = state.moments[slow_memory].sum.data() + start;
    const auto [keep_fast, keep_slow] = state.keep;
    double total_fast = 0.0;
    double total_slow = 0.0;
#pragma GCC unroll 2
    for (int b = r; b < window; ++b) {
        const double x = row[static_cast<unsigned>(b)];
        const double of_fast = keep_fast * fast[b] + x;
        const double of_slow = keep_slow * slow[b] + x;
        fast[b] = of_fast;
        slow[b] = of_slow;
        total_fast += of_fast;
        total_slow += of_slow;
    }
    state.trace[fast_memory] += fast[r];
    state.trace[slow_memory] += slow[r];
    state.total[fast_memory] += 2.0 * total_fast - fast[r];
    state.total[slow_memory] += 2.0 * total_slow - slow[r];
}

// The last row is folded: the moments are those of a time.
void complete(const MotionMomentsConfig& config, MotionMomentsState& state) noexcept {
    const int window = window_of(config);
    MotionBlock& block = state.folding;
    for (unsigned m = 0; m < state.moments.size(); ++m) {
        Moments& moments = state.moments[m];
        moments.n_windows = state.keep[m] * moments.n_windows + block.n_windows;
        // Half-ticks: as if both halves of a tick turned alike.
        const double of_samples = state.trace[m] / window - state.total[m] / (window * window);
        const double stride = samples_per_tick(config);
        moments.scatter = stride * stride * (of_samples > 0.0 ? of_samples : 0.0) / moments.n_windows;
    }
    state.n_folded = (state.n_folded + 1) % 0x10000;
    state.trace = {};
    state.total = {};
    block = MotionBlock{};
    state.folded_rows = 0;
    state.due_rows = 0;
}

void fold_due(const MotionMomentsConfig& config, MotionMomentsState& state, int n_rows) noexcept {
    state.due_rows += n_rows;
    while (state.folded_rows < window_of(config) && state.folded_rows < state.due_rows) fold_row(config, state);
    if (state.due_rows >= window_of(config)) complete(config, state);
}

void close_block(const MotionMomentsConfig& config, MotionMomentsState& state) noexcept {
    finish_folding(config, state);
    const double n = state.block.n_windows;
    for (unsigned m = 0; m < state.keep.size(); ++m) state.keep[m] = exponential(-n / memory_windows[m]);
    if (state.n_levels < level_blocks) state.n_levels += n / block_windows;
    const double part = n / block_windows / (state.n_levels > 1.0 ? state.n_levels : 1.0);
    const double moved = part * (state.block_sum / n);
    state.level += moved;
    state.folding = state.block;
    state.folding.last = state.recent;
    state.block = MotionBlock{};
    state.block_sum = 0.0;
    // The samples at hand move to the new level.
    const double each = moved / samples_per_tick(config);
    for (unsigned k = 0; k < static_cast<unsigned>(window_of(config)); ++k) state.recent[k] -= each;
}

// No gyro turns that far in a tick; the squares of less stay numbers.
bool is_possible(double x) noexcept { return x > -1e15 && x < 1e15; }

}  // namespace

MotionMomentsOutput step(const MotionMomentsConfig& config, MotionMomentsState& state,
                         const MotionTick& tick) noexcept {
    MotionMomentsOutput out;
    const bool usable = tick.usable && is_possible(tick.first) && is_possible(tick.second);
    if (is_folding(state)) fold_due(config, state, rows_a_tick * samples_per_tick(config));
    if (!usable) end_block(config, state);
    if (!usable) return out;
    if (state.n_levels == 0.0 && state.n_recent == 0)
        state.level = config.halves ? tick.first + tick.second : tick.first;
    shift_in(config, state, tick);
    if (state.n_recent < window_of(config)) return out;
    out.has_window = true;
    add_window(config, state);
    if (state.block.n_windows == block_windows) close_block(config, state);
    return out;
}

void finish_folding(const MotionMomentsConfig& config, MotionMomentsState& state) noexcept {
    if (is_folding(state)) fold_due(config, state, window_of(config));
}

void fold_ahead(const MotionMomentsConfig& config, MotionMomentsState& state) noexcept {
    const int most_rows = window_of(config) < rows_ahead ? window_of(config) : rows_ahead;
    while (is_folding(state) && state.folded_rows < most_rows) fold_row(config, state);
}

void end_block(const MotionMomentsConfig& config, MotionMomentsState& state) noexcept {
    if (state.n_recent == 0) return;
    state.n_recent = 0;
    if (state.block.n_windows > 0) close_block(config, state);
}

double moment(const MotionMomentsConfig& config, const Moments& moments, int a, int b) noexcept {
    if (!(moments.n_windows > 0.0)) return 0.0;
    return moments.sum[static_cast<unsigned>(moment_index(window_of(config), a, b))] / moments.n_windows;
}

}  // namespace zlg::core
