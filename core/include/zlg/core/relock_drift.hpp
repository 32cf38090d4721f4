#pragma once
// False drift after the perimeter loop is closed again, from what was measured in the same tick.
//
// While the detuning dl decays, the bias f = f0 (1 - chi dl^2) of the second half of a tick differs from that of the
// first, and the tick reads a rotation that is not there:
//
//   dOm = (chi f0 / 2) (<dl^2>_second - <dl^2>_first)          [counts/s, for a bias of + in the first half]
//
// frequency    dOm_i = (f_i - f0) (1 - q)/(1 + q),  q^(2(i-1)) = (f_i - f0)/(f_1 - f0);  i = 1 takes the q of i = 2
// detuning     dOm = (chi f0 / 4) ln(rho) (dl_first + dl_second)^2,  rho = dl_second / dl_first  (mean detunings)
// mean_square  the definition itself, without a model of the loop
//
// The first two assume an exponential loop, eqs (10)-(13) of the paper with its misprints corrected (docs/compensation.md).

#include <cstdint>

#include <zlg/core/discriminator_curve.hpp>
#include <zlg/core/methods.hpp>
#include <zlg/core/units.hpp>

namespace zlg::core {

struct RelockDriftConfig {
    RelockMethod method = RelockMethod::none;
    std::int64_t ticks = 20;                     // ticks after a gap that are corrected, >= 0
    Seconds tick{0.005};                         // 1e-9..1e9
    Arcsec scale{3.263};                         // per count, > 0, up to 1e9
    Hertz bias{60e3};                            // f0 at the reference temperature, > 0, up to 1e15
    double chi = 3.6;                            // >= 0
    double temperature_coefficient_per_c = 0.0;  // finite
    Celsius reference_temperature{20.0};         // finite
    Wavelengths light_noise{0.0033};             // of one light sample, >= 0
    int light_samples = 16;                      // a half, >= 1
    DiscriminatorCurve curve{};                  // for detunings that the linear law has read; none: they are right
};

enum class RelockDriftFault : unsigned char {
    none,
    ticks,
    tick,
    scale,
    bias,
    chi,
    temperature,
    light_noise,
    light_samples,
    curve
};

[[nodiscard]] RelockDriftFault check(const RelockDriftConfig& config) noexcept;

// f0 at a temperature; NaN: at the reference temperature.
[[nodiscard]] Hertz bias_at(const RelockDriftConfig& config, Celsius temperature) noexcept;

// One measured tick, its halves in order of time.
struct RelockTick {
    int sign = 1;  // bias_sign * mode in the first half
    std::int64_t counts_first = 0;
    std::int64_t counts_second = 0;
    double known_excess_counts = 0.0;    // of the first over the second, by shifted edges: not the bias's deficit
    double detuning_first_lambda = 0.0;  // NaN where not measured
    double detuning_second_lambda = 0.0;
    double detuning_sq_first_lambda2 = 0.0;
    double detuning_sq_second_lambda2 = 0.0;
    double temperature_c = 0.0;  // NaN where not measured: the reference temperature is taken
};

struct RelockDriftState {
    std::int64_t since_gap = 0;     // index i of the last tick after a gap; 0: no gap yet, or in one
    bool armed = false;             // a gap has been seen and its ticks are not used up
    double first_deficit_hz = 0.0;  // f_1 - f0

    friend bool operator==(const RelockDriftState&, const RelockDriftState&) = default;
};

// A false angle to be subtracted from a tick.
struct FalseAngle {
    bool known = false;
    double value_arcsec = 0.0;
    double variance_arcsec2 = 0.0;
};

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
//         (0, 1)); no number in it is ever NaN.
[[nodiscard]] RelockDriftOutput step(const RelockDriftConfig& config, RelockDriftState& state,
                                     const RelockTick& tick) noexcept;

}  // namespace zlg::core
