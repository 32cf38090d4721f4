#pragma once
// Rotation of the base in step with the switches: what of it shows, and what of it could be there unseen.
//
// A rotation that turns its sign with the mode has the same mean rates as a magnetic drift. Two things tell them apart.
//
// **The shape of the rate within the segments.** A magnetic drift is steady in a segment; a rotation is so only if it jumps just when the
// gyro switches. With c_k = m_k times the curvature of the rate in segment k (segment_rate.hpp), or its change,
//
//   C = sum w_k c_k / sum w_k,    Var C = sum (w_k c_k)^2 / (sum w_k)^2                                   (1)
//
// w_k the weight of the segment; older segments fade. Motion that is not in step leaves a C within a few of its standard
// deviations; of one in step the part of C^2 beyond 16 Var C is said to show. The mean rate of a sine is about as large as its C,
// that of a square wave that jumps 0.08 of a segment beside the switch four times as large; four times is presumed. The same
// test of half the innovations, which alternate by twice what the drift is wrong by, shows a drift that the segments
// contradict.
//
// **The times of the switches.** A square wave of a steady period stays in step only with a steady schedule. With e_k the
// time by which switch k has wandered from a regular grid, in intervals, a wave that follows half of that jumps |e_k|/2 within
// the segment. A jump by the part e gives it a curvature of 630 |e|^3 of its amplitude as long as that is small. So there may be
// an unseen wave of
//
//   4 sqrt(Var C) / mean of min(630 |e/2|^3, 1)                                                             (2)
//
// which is infinite on a regular grid.

#include <array>

namespace zlg::core {

enum InStepPart : unsigned char { alternation, change_in_step, curvature_in_step, in_step_parts };

struct MotionInStepState {
    double weight = 0.0;                         // sum of w
    std::array<double, in_step_parts> sum{};     // of w c
    std::array<double, in_step_parts> square{};  // of its square
    double interval_s = 0.0;                     // mean, of the switches
    double offset = 0.0;                         // of the present switch, in intervals
    double mean_offset = 0.0;                    // e is the difference
    double visible = 0.0;                        // mean of (2)

    friend constexpr bool operator==(const MotionInStepState&, const MotionInStepState&) = default;
};

// A segment has ended: m times half the innovation of its mean rate, times the change of the rate, without what a known drift
// explains, and times its curvature, arcsec/s.
void note_segment(MotionInStepState& state, double weight, const std::array<double, in_step_parts>& shape) noexcept;

// The gyro has switched, `interval_s` after the last time, > 0.
void note_switch(MotionInStepState& state, double interval_s) noexcept;

// Variance of the drift by the motion that shows, (arcsec/s)^2; 0 where there is none.
//
// trend_variance  of the change that a drift explains
[[nodiscard]] double seen_in_step(const MotionInStepState& state, double trend_variance) noexcept;

// Square of what the drift is wrong by according to its innovations, (arcsec/s)^2; 0 where they are at random.
[[nodiscard]] double mismatch_sq(const MotionInStepState& state) noexcept;

// Variance of what may be there unseen, (2) squared.
[[nodiscard]] double unseen_in_step(const MotionInStepState& state) noexcept;

}  // namespace zlg::core
