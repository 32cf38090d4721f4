#pragma once
// False drift after the perimeter loop is closed again, from what was measured in the same tick.
//
// While the detuning dl decays, the bias f = f0 (1 - chi dl^2) of the second half of a tick differs from that of the
// first, and the tick reads a rotation that is not there:
//
//   dOm = (chi f0 / 2) (<dl^2>_second - <dl^2>_first)          [counts/s, for a bias of + in the first half]
//
// frequency    dOm_i = (f_i - f0) (1 - q)/(1 + q),  q^(2(i-1)) = (f_i - f0)/(f_1 - f0);  i = 1 uses the q of i = 2
// detuning     dOm = (chi f0 / 4) ln(rho) (dl_first + dl_second)^2,  rho = dl_second / dl_first  (mean detunings)
// mean_square  the definition itself, without a model of the loop
//
// The loss may have terms beyond the square (LossBend): `mean_square` and `detuning` take them by the moments of the
// halves. Where the bias is largest at a detuning c from where the loop settles, the square is that of dl - c, and
// `detuning` has - chi f0 c (dl_second - dl_first) more. The first two assume an exponential loop, eqs (10)-(13) of the
// paper with its misprints corrected (docs/compensation.md).

#include <cstdint>

#include <zlg/core/compensation/compensation_constants.hpp>
#include <zlg/core/methods.hpp>
#include <zlg/core/records.hpp>
#include <zlg/core/units.hpp>

namespace zlg::core {

struct RelockDriftConfig {
    RelockMethod method = RelockMethod::none;
    std::int64_t ticks = 20;  // ticks after a gap that are corrected, >= 0
    // With `none`: these ticks are due, and what they may lack is presumed; it is not that there is none.
    bool presumes = false;
};

// One measured tick, its halves in order of time. A detuning of NaN or 0 was not measured; the temperature is that of
// the first half, sampled in the middle of the tick.
struct RelockTick {
    const HalfRecord& first;
    const HalfRecord& second;
    double known_excess_counts = 0.0;  // part of first minus second that is not the bias (gyro_compensation.cpp)
    bool with_phase = false;           // the places within the count are in it
};

struct RelockDriftState {
    std::int64_t since_gap = 0;      // index i of the last tick after a gap; 0: no gap yet, or in one
    bool armed = false;              // a gap has been seen and its ticks are not used up
    double first_deficit_hz = 0.0;   // f_1 - f0
    double first_most_arcsec = 0.0;  // false angle that tick 1 may have

    friend bool operator==(const RelockDriftState&, const RelockDriftState&) = default;
};

// A false angle to be subtracted from a tick. Of one that is not known but may be there: 0, and the square of its
// likely size.
struct FalseAngle {
    bool known = false;
    double value_arcsec = 0.0;
    double variance_arcsec2 = 0.0;
};

// A perimeter that a loop has caught is no farther off; the next mode begins there.
inline constexpr Wavelengths max_detuning{0.25};

struct RelockDriftOutput {
    bool due = false;        // this tick is among those to be corrected
    bool waiting = false;    // it is tick 1 of `frequency`, which the next tick decides
    FalseAngle tick{};       // of this tick
    bool first_due = false;  // tick 1 of `frequency` is decided now
    FalseAngle first{};      // of the previous tick
};

// A tick in a gap: the next measured tick is i = 1.
void enter_gap(RelockDriftState& state) noexcept;

// A measured tick.
//
// return  what to subtract. `known` is false where the data do not allow a correction (no detuning, or a ratio outside
//         (0, 1)): what is missing is then as large as the light of its first half lets it be, or without light as half
//         of what `max_detuning` does, of which tick i has no more than a part 1/(2i - 1), however the loop settles.
//         With `frequency` it is no larger than the tick's own deficit f_i - f0 either. No number in it is ever NaN.
[[nodiscard]] RelockDriftOutput step(const CompensationConstants& gyro, const RelockDriftConfig& config,
                                     RelockDriftState& state, const RelockTick& tick) noexcept;

// Variance of what no correction subtracts from a tick: before the first gap of a log, and later than `ticks` after
// one. Where the light shows a false angle beyond its noise, because the loop still settled or the perimeter was
// pushed, or swings so that its noise may hide one, its square and the noise of the light, found by a trial step from
// the state just after a gap. Where there is no mean square, what a detuning of .01 wavelength costs.
//
// state             before `step` takes this tick.
// variance_arcsec2  of the tick.
[[nodiscard]] double pushed_arcsec2(const CompensationConstants& gyro, const RelockDriftConfig& config,
                                    const RelockDriftState& state, const RelockTick& tick,
                                    double variance_arcsec2) noexcept;

}  // namespace zlg::core
