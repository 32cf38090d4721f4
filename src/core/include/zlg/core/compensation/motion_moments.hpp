#pragma once
// Second moments of the motion as the counter reads it, learnt while the loop is closed.
//
//   C_ab = sum over windows of x_a x_b,   a window: 19 consecutive usable ticks, or their 38 half-ticks
//
// Neighbouring windows share their samples, so the matrix of a block of windows follows from its first rows:
//
//   C_(a+s)(b+s) = C_ab + e_(a+s) e_(b+s) - f_a f_b,   s samples a tick, f the first and e the last window of the block
//
// A tick costs s rows of products instead of the whole matrix. A block that is over (100 windows, or a gap) is unfolded row by
// row and added to two matrices that forget exponentially.

#include <array>

namespace zlg::core {

inline constexpr int window_ticks = 19;
inline constexpr int max_window = 2 * window_ticks;
using Window = std::array<double, max_window>;

struct MotionMomentsConfig {
    bool halves = false;  // samples are half-ticks
};

[[nodiscard]] constexpr int samples_per_tick(const MotionMomentsConfig& c) noexcept { return c.halves ? 2 : 1; }
[[nodiscard]] constexpr int window_of(const MotionMomentsConfig& c) noexcept {
    return window_ticks * samples_per_tick(c);
}

// Where the upper triangle holds row a, column b >= a.
[[nodiscard]] constexpr int moment_index(int window, int a, int b) noexcept { return a * (2 * window - 1 - a) / 2 + b; }

// Moments about the level, forgotten exponentially.
struct Moments {
    double n_windows = 0.0;                                     // less what is forgotten
    double scatter = 0.0;                                       // mean square of a tick about the mean of its window
    std::array<double, max_window*(max_window + 1) / 2> sum{};  // upper triangle by rows

    friend bool operator==(const Moments&, const Moments&) = default;
};

// A block of windows.
struct MotionBlock {
    int n_windows = 0;
    Window first{};
    std::array<Window, 2> row{};  // the first rows of its matrix

    friend bool operator==(const MotionBlock&, const MotionBlock&) = default;
};

enum MotionMemory : unsigned { fast_memory, slow_memory };  // of 500 and 3000 windows

struct MotionMomentsState {
    int n_recent = 0;    // usable samples in a row, up to a window
    Window recent{};     // the last ones, without the level
    double level = 0.0;  // slow mean of a tick, taken from every sample
    double n_levels = 0.0;
    double block_sum = 0.0;
    MotionBlock block{};
    int n_folded = 0;  // blocks so far, modulo 2^16
    std::array<Moments, 2> moments{};

    friend bool operator==(const MotionMomentsState&, const MotionMomentsState&) = default;
};

// What a tick adds: its angle, or the angles of its halves without the bias.
struct MotionTick {
    bool usable = false;  // measured, and free of re-lock
    double first = 0.0;
    double second = 0.0;  // of half-ticks alone
};

struct MotionMomentsOutput {
    bool has_window = false;  // `recent` is a window that ends now
};

// Take one tick.
//
// cost  19 products a tick, or 76 for halves; where a block ends, three for each of the 190, or 741, elements of the matrix
//       and one for each memory.
[[nodiscard]] MotionMomentsOutput step(const MotionMomentsConfig& config, MotionMomentsState& state,
                                       const MotionTick& tick) noexcept;

// The row of usable ticks is broken: the block ends, however short, and is added.
void end_block(const MotionMomentsConfig& config, MotionMomentsState& state) noexcept;

// Mean product of samples a and b of a window, a <= b; 0 before the first window.
[[nodiscard]] double moment(const MotionMomentsConfig& config, const Moments& moments, int a, int b) noexcept;

}  // namespace zlg::core
