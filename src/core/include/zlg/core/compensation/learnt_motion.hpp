#pragma once
// What is learnt of the motion: second moments of all windows of L settled halves in a row, forgotten exponentially.
//
//   C_ij = sum over windows t of x_(t+i) x_(t+j)                                                            (1)
//
// the covariance method of linear prediction (Makhoul, Proc. IEEE 63 (1975) 561). It is positive, and not smeared by a taper as
// autocovariances are. For all windows of a run of n halves it follows from the products of the run by their distance k,
//
//   P_k = sum over s of x_s x_(s+k),    C_i(i+k) = P_k - (those with s < i) - (those with s > n - L + i)    (2)
//
// so that a half costs L products, and the matrix L^2 only where a run ends: at a gap, or after `block_halves`. The next run
// then begins with the last L - 1 halves of this one, and no window is lost. Its mean is taken off: contrasts do not see it, but the
// law of the roundings does. The sums are made alike in both directions of time.
//
// Halves go in by parts that end where their index is a multiple of `part_halves`: what a memory holds is a function of the
// indices of halves, whenever it is computed.

#include <array>
#include <cstdint>

#include <zlg/core/compensation/switch_window.hpp>

namespace zlg::core {

inline constexpr int part_halves = 16;
inline constexpr int block_halves = 1024;

struct LearntMotion {
    MotionMoments moments{};                           // of the runs that have ended
    double level_arcsec = 0.0;                         // first half of the run: what is subtracted from all
    int n_run = 0;                                     // halves of the run in the products
    int n_waiting = 0;                                 // and those that wait for the end of their part
    double sum = 0.0;                                  // of the n_run halves
    double mean_arcsec = 0.0;                          // of a half, in the run that was folded last
    std::array<double, most_window_halves> product{};  // P_k
    std::array<double, most_window_halves> head{};     // the first L - 1 halves of the run
    std::array<double, most_window_halves + part_halves> recent{};  // its last L - 1 halves, then those that wait

    friend bool operator==(const LearntMotion&, const LearntMotion&) = default;
};

// Begin with nothing learnt.
//
// length  L, even, up to most_window_halves.
void start(LearntMotion& memory, int length) noexcept;

// A half; its index; its angle without the bias.
//
// settled       measured, and free of re-lock; another half ends the run.
// forget_ticks  age at which a window counts 1/e.
void add(LearntMotion& memory, std::int64_t half, bool settled, double angle_arcsec, double forget_ticks) noexcept;

// Mean of a half in the run that was folded last.
[[nodiscard]] inline double mean_half_arcsec(const LearntMotion& memory) noexcept { return memory.mean_arcsec; }

}  // namespace zlg::core
