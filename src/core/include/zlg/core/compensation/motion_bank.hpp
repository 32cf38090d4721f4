#pragma once
// The bank: motions that were not learnt, each a random walk of a derivative of the rate somewhere in the window.
//
// A member is a row, and stands for as many models as there are sizes. One that begins exactly at the end of the gap would
// take a ramp that begins late in the gap for one that begins after it: the first begins a tick later.

#include <array>

#include <zlg/core/compensation/walk_kernel.hpp>

namespace zlg::core {

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

// Variances of a member, in units of the variance of a half that its neighbours do not foretell: 10^-0.5 to 10^11.5, 10^1.5 apart.
inline constexpr std::array<double, 9> motion_sizes{0.31622776601683794, 10.0,       316.22776601683796, 10000.0,
                                                    316227.7660168379,   10000000.0, 316227766.01683795, 10000000000.0,
                                                    316227766016.83795};

}  // namespace zlg::core
