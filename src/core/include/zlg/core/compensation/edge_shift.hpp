#pragma once
// Shifted bias edges: what they add to the counts of a tick, and its rotation in even time.
//
// The counter is latched at the reversals. Where these come e ticks of the timer late, a half lasts d = e_end - e_start
// longer than nominal. Its edges stay whole, so the plateau f of the bias fills the difference; and the tick as a whole
// rotates for another time. With c the counts of both halves, K the scale, e_0 and e_2 at the ends of the tick:
//
//   A = (f/timer) (sum of bias_sign * mode * d)         known area: whole ticks of the timer times f
//   r = (c - A)/(T + (e_2 - e_0)/timer)                 rate
//   P = K (c - A) - x + x_before,  x = K (r + (r - r_before)/2) e_2/timer
//
// x is the rotation between the even and the shifted end of the tick, at the rate expected there. The next tick gets
// back the very x that this one gives away, so that the sum of all P is that of the counts, less the area. Of n ticks
// read as one T is n ticks, the middle of the tick before lies (n + 1)/2 before theirs, and n/(n + 1) stands for 1/2.

#include <cstdint>

#include <zlg/core/compensation/angle.hpp>
#include <zlg/core/compensation/compensation_constants.hpp>
#include <zlg/core/records.hpp>
#include <zlg/core/units.hpp>

namespace zlg::core {

// A shift that leaves both halves beside it some time: less than a quarter of a tick.
[[nodiscard]] bool is_possible(const CompensationConstants& gyro, std::int32_t edge_offset_ticks) noexcept;

// Counts that the bias makes in one tick of the timer, on its plateau. Beyond 1e15 Hz it counts as 0.
[[nodiscard]] double plateau_per_tick(const CompensationConstants& gyro, Hertz bias) noexcept;

struct EdgeShiftState {
    std::int32_t offset_ticks = 0;  // of the last reversal
    bool follows = false;           // the tick before is measured, its two numbers are known:
    double turn_counts = 0.0;       // r T
    double beyond_arcsec = 0.0;     // x
    ExactSum residual_arcsec{};     // rounding residual of P, added to the next P

    friend bool operator==(const EdgeShiftState&, const EdgeShiftState&) = default;
};

// P of n ticks from the shifted end of the last one on, as one: their counts, and those of A.
[[nodiscard]] double even_angle(const CompensationConstants& gyro, EdgeShiftState& state, double counts, double area,
                                std::int32_t end_ticks, double n_ticks = 1.0) noexcept;

struct EdgeShiftOutput {
    double value_arcsec = 0.0;         // P: without shifts exactly scale * counts
    double known_excess_counts = 0.0;  // of the first half over the second by what they differ in length
};

// One tick, its halves in order of time.
//
// gyro   passed `check`.
// parts  of a count beyond the counts: 1/65536.
[[nodiscard]] EdgeShiftOutput step(const CompensationConstants& gyro, EdgeShiftState& state, const HalfRecord& first,
                                   const HalfRecord& second, std::int32_t parts) noexcept;

// The tick before was not measured: the next one uses its own rate for the time between its even and its shifted start.
void break_off(EdgeShiftState& state) noexcept;

}  // namespace zlg::core
