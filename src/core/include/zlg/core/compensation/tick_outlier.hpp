#pragma once
// A tick that stands apart from its neighbours: what the counter read may be wrong, or the gyro was struck.
//
//   d = y_j - (y_(j-2) + y_(j-1) + y_(j+1) + y_(j+2))/4
//
// A bit of the counter that becomes stuck, or a single reading that is damaged, puts its error into one tick. Where
// the rotation is even, rounding makes |d| at most 1.5 counts, the sum of the weights of the roundings, and the mean of d^2
// at most 3 times a tick's variance, at a rate of a third of a count in a tick. Uneven rotation adds to it what it has added before, its roughness:
//
//   apart     where d^2 > l^2,   l^2 = 27/2 v + 16 q           v: the largest variance of the five, at least that of whole counts
//   q <- q + (min(d^2, l^2) - 3 v - q)/128                  the mean, at first of fewer ticks
//
// As a tick adds at most l^2, an error in fewer than one tick of 16 is never learnt as rotation. One in all of them is, by
// an eighth with each that is learnt: a vibration that begins with a d of 8 counts is the usual motion after 0.5 s of 5 ms ticks.
// By phase v is that of such a reading.
// A tick that stands apart gains the variance d^2/4: whether d was turned is not known. Bridges that learn the motion do so;
// with a polynomial a row depends on the ticks around it alone.

#include <cstdint>

namespace zlg::core {

struct TickOutlierState {
    double roughness_arcsec2 = 0.0;  // q
    std::int32_t n = 0;              // ticks in it, up to 128

    friend constexpr bool operator==(const TickOutlierState&, const TickOutlierState&) = default;
};

// Advance by one tick; returns the variance that it gains.
//
// apart_arcsec       d.
// variance_arcsec2   v, finite.
// learns             all five ticks were measured; one such tick in four is enough.
[[nodiscard]] double step(TickOutlierState& state, double apart_arcsec, double variance_arcsec2, bool learns) noexcept;

}  // namespace zlg::core
