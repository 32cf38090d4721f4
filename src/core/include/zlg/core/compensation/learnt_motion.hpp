#pragma once
// What is learnt of the motion: second moments of all windows of L settled steps in a row, forgotten exponentially. A
// step is a half, or a tick where the windows would be too long.
//
//   C_ij = sum over windows t of x_(t+i) x_(t+j)                                                            (1)
//
// the covariance method of linear prediction (Makhoul, Proc. IEEE 63 (1975) 561). It is positive, and not smeared by a
// taper as autocovariances are. For all windows of a run of n steps it follows from the products of the run by their
// distance k,
//
//   P_k = sum over s of x_s x_(s+k),    C_i(i+k) = P_k - (those with s < i) - (those with s > n - L + i)    (2)
//
// so that a step costs L products, and the matrix L^2 only where a run ends: at a gap, or after `block_halves`. The
// next run then begins with the last L - 1 steps of this one, and no window is lost; their own products are added with
// the matrix. The mean of a run is taken off: contrasts do not see it, but the law of the roundings does. The sums are
// made alike in both directions of time.
//
// Steps go in by parts that end where the index of their last half is a multiple of `part_halves`: what a memory holds
// is a function of the indices of halves, whenever it is computed.

#include <array>
#include <cstdint>

#include <zlg/core/compensation/switch_window.hpp>

namespace zlg::core {

inline constexpr int part_halves = 16;
inline constexpr int block_halves = 1024;

struct LearntMotion {
    MotionMoments moments{};     // of the runs that have ended
    std::int64_t next_tick = 0;  // that is to be learnt
    bool with_phase = false;     // the readings that it was learnt from
    double level_arcsec = 0.0;   // first step of the run: what is subtracted from all
    bool goes_on = false;        // its head lies in the run before it: the products do not hold those of the head alone
    int n_run = 0;               // steps of the run in the products
    int n_waiting = 0;           // and those that wait for the end of their part
    double sum = 0.0;            // of the n_run steps
    std::array<double, most_moment_steps> product{};               // P_k
    std::array<double, most_moment_steps> head{};                  // its first L - 1 steps
    std::array<double, most_moment_steps + part_halves> recent{};  // its last L - 1 steps, then those that wait

    friend bool operator==(const LearntMotion&, const LearntMotion&) = default;
};

// Begin with nothing learnt.
//
// length       L, even, up to most_moment_steps.
// step_halves  1 or 2.
void start(LearntMotion& memory, int length, int step_halves) noexcept;

// A step: the index of its last half, and its angle without the bias.
//
// settled       measured, and free of re-lock; another step ends the run.
// forget_ticks  age at which a window counts 1/e.
void add(LearntMotion& memory, std::int64_t half, bool settled, double angle_arcsec, double forget_ticks) noexcept;

// How far the motion scatters, as the half-periods need it: of settled ticks, each forgotten as what is learnt is.
struct MotionSpread {
    double n_ticks = 0.0;  // in the means, up to those after which a tick counts 1/e
    double mean_half_arcsec = 0.0;
    double tick_arcsec2 = 0.0;               // variance of a tick about the mean
    double second_difference_arcsec2 = 0.0;  // of three halves in a row
    bool goes_on = false;                    // the tick before was settled:
    std::array<double, 2> last_arcsec{};     // its halves

    friend bool operator==(const MotionSpread&, const MotionSpread&) = default;
};

// Add one tick; its halves, without the bias.
void add(MotionSpread& spread, bool settled, double first_arcsec, double second_arcsec, double forget_ticks) noexcept;

}  // namespace zlg::core
