#pragma once
// The half-wave voltage U_lambda/2: what moves the perimeter by half a wavelength, from one mode to its neighbour.
//
// It is measured at every switch, because it changes with temperature and with the hysteresis of the piezo.

#include <cstdint>

#include <zlg/core/common/maths.hpp>
#include <zlg/core/control/piezo_range.hpp>
#include <zlg/core/units.hpp>

namespace zlg::core {

struct HalfWaveConfig {
    Volts presumed{40.0};               // before the first measurement, 1e-3..1e6 V
    double presumed_sigma_ratio = 0.1;  // one standard deviation of `presumed` over itself, 0..1 exclusive
    Volts measurement_sigma{0.3};       // of |U- - U+| at one switch: converter, residual detuning, hysteresis
    Volts process_sigma{0.1};           // true change from one switch to the next
    double gate = 4.0;                  // a measurement farther off than this many standard deviations is an outlier
};

enum class HalfWaveFault : unsigned char { none, presumed, presumed_sigma, measurement_sigma, process_sigma, gate };

[[nodiscard]] constexpr HalfWaveFault check(const HalfWaveConfig& c) noexcept {
    if (!(c.presumed >= Volts{1e-3} && c.presumed <= Volts{1e6})) return HalfWaveFault::presumed;
    if (!(c.presumed_sigma_ratio > 0.0 && c.presumed_sigma_ratio < 1.0)) return HalfWaveFault::presumed_sigma;
    if (!(c.measurement_sigma > Volts{0.0} && c.measurement_sigma <= Volts{1e6})) {
        return HalfWaveFault::measurement_sigma;
    }
    if (!(c.process_sigma >= Volts{0.0} && c.process_sigma <= Volts{1e6})) return HalfWaveFault::process_sigma;
    if (!(c.gate > 0.0 && c.gate <= 100.0)) return HalfWaveFault::gate;
    return HalfWaveFault::none;
}

struct HalfWaveState {
    double estimate_v = 0.0;
    double variance_v2 = 0.0;
    std::int32_t n_accepted = 0;
    std::int8_t outlier_side = 0;  // of the last measurement: +1 above the gate, -1 below; 0: inside

    friend constexpr bool operator==(const HalfWaveState&, const HalfWaveState&) = default;
};

struct HalfWaveOutput {
    Volts half_wave{};
    bool rejected = false;  // the measurement was not finite, or an outlier; the estimate is held
};

[[nodiscard]] constexpr HalfWaveState initial_state(const HalfWaveConfig& c) noexcept {
    const double sigma_v = c.presumed_sigma_ratio * c.presumed.value();
    return {.estimate_v = c.presumed.value(), .variance_v2 = sigma_v * sigma_v};
}

// One standard deviation of the estimate.
[[nodiscard]] inline Volts sigma(const HalfWaveState& s) noexcept { return Volts{square_root(s.variance_v2)}; }

// Update with the measurement of one switch: a scalar Kalman filter for a random walk.
//
//   p = variance + process_sigma^2,  K = p / (p + measurement_sigma^2)
//   estimate += K (measured - estimate),  variance = (1 - K) p
//
// A second outlier in a row on the same side is accepted, with p = (measured - estimate)^2: the first loops of a piezo
// with hysteresis differ from its later ones.
//
// config    passed `check`.
// state     from `initial_state`; the estimate stays between half and twice the presumed voltage.
// measured  |U- - U+|, each settled; NaN stands for no measurement. Outliers, and values outside half to twice the
//           presumed voltage (the loop has caught another mode), are rejected; the variance grows all the same, up to
//           that of the presumed value.
[[nodiscard]] HalfWaveOutput step(const HalfWaveConfig& config, HalfWaveState& state, Volts measured) noexcept;

struct SwitchDirection {
    std::int8_t sign = 1;       // of U- - U+
    bool out_of_range = false;  // neither neighbour keeps the margin: this one has more room
};

// Which neighbour to switch to: the one inside the range, margin kept, and nearest to the middle of the range.
[[nodiscard]] SwitchDirection choose_direction(const PiezoRange& range, Volts now, Volts half_wave) noexcept;

}  // namespace zlg::core
