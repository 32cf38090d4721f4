#pragma once
// Second moments of the motion as the counter reads it, learnt while the loop is closed: the covariance method of
// linear prediction, with the products of overlapping windows (Makhoul, Proc. IEEE 63 (1975) 561; Box and Jenkins, ch.
// 2).
//
//   C_ab = sum over windows of x_a x_b                                                                  (1)
//
// A window is 19 consecutive usable ticks, or their 38 half-ticks, less the level. C is not forced to be Toeplitz: the
// usual autocovariances are either not positive definite (unbiased) or wrong by the taper (biased), and five times
// worse here. Neighbouring windows share all but s samples (s samples a tick), so the matrix of a block of windows
// follows from its first s rows:
//
//   C_(a+s)(b+s) = C_ab + e_(a+s) e_(b+s) - f_a f_b,   f the first and e the last window of the block     (2)
//
// A tick costs s rows of products instead of the whole matrix. A block that is complete (100 windows, or a gap) is
// unfolded by (2) row by row, while it is added to two memories M that forget exponentially,
//
//   M <- exp(-n/N) M + C,   n: windows of the block,   N = 500 and 3000                                   (3)
//
// The level, the slow mean of a tick, is an average over some 20 blocks.
//
// Windows of whole counts hold their rounding, ten thousand times the variance of a reading by phase, and would spoil the
// memories for as long as these remember it. So a block holds windows of one kind, and the first one by phase, of 50
// windows or more, begins both memories anew. Where the place within the count is lost for less than a block, the whole
// counts are left out.

#include <array>

namespace zlg::core {

inline constexpr int window_ticks = 19;
inline constexpr int max_window = 2 * window_ticks;

// Windows in the moments before they are used; they come by blocks, so at the end of the first whole block, 0.6 s of 5 ms
// ticks, or of a shorter one that a gap ends. With fewer the moments describe these few ticks and not the motion. By trial
// on bench/accuracy.
inline constexpr int min_windows = 50;

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
    double n_windows = 0.0;  // effective number: each fades as its products do, (3)
    double by_phase = 0.0;   // part of them in which the place within the count was known
    double scatter = 0.0;    // mean square of a tick about the mean of its window
    std::array<double, max_window*(max_window + 1) / 2> sum{};  // upper triangle by rows

    friend bool operator==(const Moments&, const Moments&) = default;
};

// A block of windows.
struct MotionBlock {
    int n_windows = 0;
    bool with_phase = false;      // all of them, or none
    Window first{};               // f of (2)
    std::array<Window, 2> row{};  // the first s rows of its matrix

    friend bool operator==(const MotionBlock&, const MotionBlock&) = default;
};

enum MotionMemory : unsigned { fast_memory, slow_memory };  // of 500 and 3000 windows

struct MotionMomentsState {
    bool with_phase = false;  // the places within the count have been known at the borders of all recent ticks
    int n_recent = 0;         // usable samples in a row, up to a window
    Window recent{};          // the last ones, less the level
    double level = 0.0;       // slow mean of a tick, subtracted from every sample
    double n_levels = 0.0;    // blocks in the level, up to 20
    double block_sum = 0.0;   // sum of the last tick of each window of the block
    int n_folded = 0;         // blocks so far, modulo 2^16
    MotionBlock block{};
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
    bool has_window = false;      // `recent` is a window that ends now
    bool began_by_phase = false;  // the memories hold readings by phase alone from now on, and did not before
};

// Add one tick.
//
// cost  19 products a tick, or 76 for halves; where a block ends, three for each of the 190, or 741, elements of the matrix
//       and one for each memory.
[[nodiscard]] MotionMomentsOutput step(const MotionMomentsConfig& config, MotionMomentsState& state,
                                       const MotionTick& tick) noexcept;

// Mean product of samples a and b of a window, a <= b; 0 before the first window.
[[nodiscard]] double moment(const MotionMomentsConfig& config, const Moments& moments, int a, int b) noexcept;

}  // namespace zlg::core
