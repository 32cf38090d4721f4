#pragma once
// Static lock-in: what the pull of the scattered light takes from the counts of a tick.
//
// Adler's equation with a threshold L lets a beat of f run at b = sign(f) sqrt(f^2 - L^2). Of a half the counter shows
// b, so that f follows without anything being known of the bias:
//
//   f - b = sign(b) L^2/(|b| + sqrt(b^2 + L^2))                          on the plateau of a half, of T/2 - t_e
//   L^2 t_e r/max(f0, |r|)^2                                             over both reversals of a tick
//   b = (c - (t_e/T) (c_1 + c_2)/2)/(T/2 - t_e/2)                        of a half with counts c: its edges follow the
//   rotation
//
// with c_1 and c_2 the counts of both halves, t_e the duration of a reversal, r = (c_1 + c_2)/T the rotation and f0 the
// plateau of the bias. The two halves lose unequally where the gyro turns: far from lock-in both together
// -(1/2) (L/f0)^2 r T (1 - 4 t_e/T)/(1 - (r/f0)^2), the scale error of docs/physics.md with the other sign. The law of
// the reversals is that of random phases, by the first term of (L^2 t_e/2 f0) ln|(f0 + r)/(f0 - r)|: what it leaves out
// is less than 0.003 of the whole below the bias and 0.02 beyond it, with edges of T/100.
//
// Where the threshold is known: a half whose beat may stand still (|b| below the largest threshold and a count) tells
// only that |f| is no larger than that, and the variance holds it.

#include <zlg/core/compensation/compensation_constants.hpp>
#include <zlg/core/units.hpp>

namespace zlg::core {

struct LockInConfig {
    Hertz threshold{0.0};  // L, in counts a second as the bias; 0..1e9. 0: nothing is corrected
    Hertz sigma{0.0};      // standard deviation of L, 0..1e9; with a threshold of 0 its likely size
};

[[nodiscard]] bool is_allowed(const LockInConfig& config) noexcept;

struct LostCounts {
    double value = 0.0;     // to be added to the counts
    double variance = 0.0;  // of that, the same from tick to tick at an even rate: over n ticks n^2 of it
};

// Of one tick, by the counts of its halves with their parts. Where the threshold is not known, 0 with the variance of
// what one as large as its sigma would take, by the presumed bias; where the numbers overflow, 0 with an infinite
// variance.
//
// config, gyro  passed `check`.
[[nodiscard]] LostCounts lost_to_lock_in(const CompensationConstants& gyro, const LockInConfig& config,
                                         double first_counts, double second_counts) noexcept;

}  // namespace zlg::core
