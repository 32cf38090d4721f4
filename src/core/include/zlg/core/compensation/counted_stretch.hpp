#pragma once
// The counted angle of ticks that were not measured one by one: halves without a reading, and the half whose counts go
// over all of them.
//
//   sum over ticks a..b = K (c + p - f/timer * sum of bias_sign * mode * d) - x_b + x_(a-1)
//
// c are all counts from the last reading before tick a to the one that ends tick b, p what the places within the count
// differ by at these two borders; what shifted edges add (d, x) is
// that of edge_shift.hpp. A tick has one half of each bias sign, so the bias cancels in whole ticks, where the loop was
// closed in one mode. While the detuning dl settles it does not: with s = bias_sign * mode the sum lacks
//
//   K (T/2) chi f0 sum of s <dl^2>
//
// which is known where the light was read in all halves.

#include <cstdint>

#include <zlg/core/compensation/border.hpp>
#include <zlg/core/compensation/edge_shift.hpp>
#include <zlg/core/records.hpp>

namespace zlg::core {

struct CountedStretchState {
    // A closed tick was measured since the loop was open: its detuning bounds the false drift.
    bool known_before = true;
    bool seen = true;  // in all halves since the last border between ticks with a reading the light was read
    double deficit_lambda2 = 0.0;           // sum of s <dl^2> over them
    double deficit_variance_lambda4 = 0.0;  // by the noise of the light
    double min_sq_lambda2 = 0.0;  // of the detuning in the halves from the last measured one to now; 0: not known
    double max_sq_lambda2 = 0.0;
    std::int64_t n_ticks = 0;    // since the last border between ticks with a reading
    std::int64_t counts = 0;     // over them
    std::int32_t uncovered = 0;  // halves up to now that no counts go over yet
    bool broken = false;         // the counts do not give the angle
    std::int8_t mode = 1;
    std::int64_t area_ticks = 0;  // sum of bias_sign * mode * d
    EdgeShiftState start{};       // the reversal that begins the stretch
    Border start_border{};

    friend bool operator==(const CountedStretchState&, const CountedStretchState&) = default;
};

// Its first border, its last one being that of the tick, and what the light says of it: in the state.
struct CountedStretch {
    std::int64_t n_ticks = 0;  // that end now; 0: nothing is known
    double angle_arcsec = 0.0;
    // Of the mean square of the detuning: what falls evenly leaves no more of the bias in a sum.
    double fall_lambda2 = 0.0;
};

// Mean square of the detuning from the centre of the bias, by the curve of the discriminator; 0 where it was not
// measured.
[[nodiscard]] double detuning_sq(const CompensationConstants& gyro, const HalfRecord& half) noexcept;

// Add a tick that was not measured.
//
// edges         those of the ticks before. They are put right for the next tick where a stretch ends.
// start_border  of the tick.
[[nodiscard]] CountedStretch step(const CompensationConstants& gyro, CountedStretchState& state,
                                  const HalfRecord& first, const HalfRecord& second, Hertz bias,
                                  const EdgeShiftState& edges_before, EdgeShiftState& edges,
                                  const Border& start_border = {}) noexcept;

// A measured tick: all begins anew.
//
// detuning_sq_lambda2  mean square of its second half; 0: not known.
void begin_anew(CountedStretchState& state, double detuning_sq_lambda2) noexcept;

}  // namespace zlg::core
