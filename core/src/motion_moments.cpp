#include <zlg/core/motion_moments.hpp>

#include <zlg/core/maths.hpp>

namespace zlg::core {
namespace {

constexpr int block_windows = 100;
constexpr int rows_a_tick = 4;  // of ticks; of half-ticks twice as many

// An exponential memory has as much scatter as a sliding one of twice the length.
constexpr std::array<double, 2> memory_windows{500.0, 3000.0};

// Blocks over which the level is averaged.
constexpr double level_blocks = 20.0;

void shift_in(const MotionMomentsConfig& config, MotionMomentsState& state, const MotionTick& tick) noexcept {
    const auto window = static_cast<unsigned>(window_of(config));
    const auto stride = static_cast<unsigned>(samples_per_tick(config));
    for (unsigned k = 0; k + stride < window; ++k) state.recent[k] = state.recent[k + stride];
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
    for (unsigned b = 0; b < window; ++b) block.row[0][b] += x[0] * x[b];
    if (config.halves)
        for (unsigned b = 1; b < window; ++b) block.row[1][b] += x[1] * x[b];
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
    for (unsigned b = window - 1; b >= to; --b)
        row[b] = row[b - s] + block.last[to] * block.last[b] - block.first[to - s] * block.first[b - s];
}

void fold_row(const MotionMomentsConfig& config, MotionMomentsState& state) noexcept {
    const int window = window_of(config);
    const int r = state.folded_rows++;
    MotionBlock& block = state.folding;
    if (r >= samples_per_tick(config)) unfold(config, block, r);
    const Window& row = block.row[static_cast<unsigned>(r % samples_per_tick(config))];
    for (unsigned m = 0; m < state.moments.size(); ++m) {
        double* const sum = state.moments[m].sum.data() + moment_index(window, r, 0);
        const double keep = state.keep[m];
        double total = 0.0;
        for (int b = r; b < window; ++b) {
            sum[b] = keep * sum[b] + row[static_cast<unsigned>(b)];
            total += sum[b];
        }
        state.trace[m] += sum[r];
        state.total[m] += 2.0 * total - sum[r];
    }
    if (state.folded_rows < window) return;
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
    const int n_rows = rows_a_tick * samples_per_tick(config);
    for (int k = 0; k < n_rows && is_folding(state); ++k) fold_row(config, state);
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
    while (is_folding(state)) fold_row(config, state);
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
