#pragma once
// Covariance of the motion where a derivative of the rate walks: a member of the bank.
//
// From `first` to `last` (half-ticks) white noise of intensity 1 drives the k-th derivative: k = 2 the slope of the
// rate walks, k = 3 the slope of that. A stretch [s, e) turns by the integral of a(q) dW(q),
//
//   a(q) = ((e - q)+^k - (s - q)+^k)/k                                                                     (1)
//
// and two stretches have the covariance of the integral of the product of their a. Where the second begins behind the
// end of the first, its a is a polynomial in q over all of the first, so that
//
//   cov = sum over m < k of c_m g_m,    c_m = integral of a_first(q) q^m,   g_m the coefficients of a_second   (2)
//
// and a matrix of n stretches costs n (8 points of Gauss) and n^2 k/2 products. Source of the kernels: integrated
// Wiener processes, Wahba, Spline Models for Observational Data, 1990, ch. 1 (their constant, that is (k-1)!^2, is of
// no account here).

#include <array>
#include <cstdint>

namespace zlg::core {

// A stretch of half-ticks of the window, [first, last).
struct Stretch {
    std::int16_t first = 0;
    std::int16_t last = 0;

    constexpr Stretch() noexcept = default;
    constexpr Stretch(int from, int to) noexcept
        : first{static_cast<std::int16_t>(from)}, last{static_cast<std::int16_t>(to)} {}

    friend constexpr bool operator==(const Stretch&, const Stretch&) = default;
};

// Where a walk goes on, [first, last), and which derivative walks: 2 or 3.
struct Walk {
    int kind = 2;
    int first = 0;
    int last = 0;
};

inline constexpr int most_walk_terms = 3;

// A stretch as (2) needs it, in time from the start of the walk.
struct WalkedStretch {
    double moment[most_walk_terms] = {};       // c_m
    double coefficient[most_walk_terms] = {};  // g_m
    double variance = 0.0;
};

[[nodiscard]] WalkedStretch walked(const Walk& walk, const Stretch& stretch) noexcept;

// The bank: motions that were not learnt, each a random walk of a derivative of the rate somewhere in the window.
//
// A member is a row, and stands for as many models as there are sizes. One that begins exactly at the end of the gap
// would take a ramp that begins late in the gap for one that begins after it: the first begins a tick later.
enum class WalkPlace : unsigned char {
    everywhere,  // over the window, alike in both directions of time
    beside,      // from `halves` before the gap to as many after it
    after,       // from `halves` after the gap on
};

struct BankMember {
    int kind = 2;  // derivative of the angle that walks, less 1: 2 the slope of the rate, 3 the slope of that
    WalkPlace place = WalkPlace::everywhere;
    int halves = 0;
};

inline constexpr std::array<BankMember, 6> motion_bank{{{2, WalkPlace::everywhere, 0},
                                                        {3, WalkPlace::everywhere, 0},
                                                        {2, WalkPlace::beside, 4},
                                                        {2, WalkPlace::beside, 8},
                                                        {2, WalkPlace::beside, 16},
                                                        {2, WalkPlace::after, 2}}};

// Variances of a member, in units of the variance of a half that its neighbours do not foretell: 10^-0.5 to 10^11.5,
// 10^1.5 apart.
inline constexpr std::array<double, 9> motion_sizes{0.31622776601683794, 10.0,       316.22776601683796, 10000.0,
                                                    316227.7660168379,   10000000.0, 316227766.01683795, 10000000000.0,
                                                    316227766016.83795};

}  // namespace zlg::core
