#pragma once
// What makes a twin: the gyro at rest in its numbers, and what breaks in it.

#include <cstdint>
#include <limits>
#include <vector>

#include <zlg/twin/faults.hpp>
#include <zlg/twin/laser_config.hpp>

namespace zlg::twin {

struct AveragedLaser;

inline constexpr double timer_hz = 1e7;  // of the gyro's timer, which stamps and shifts reversals

// Who closes the perimeter loop.
enum class LoopKind {
    analog,       // electronics: integrator with a limiter, then the high-voltage stage
    exponential,  // the paper's idealisation, eq (10): detuning decays with tau from the moment of closing
    external,     // nobody here: the set-points of the processor rule, closed or open
};

enum class Fidelity {
    averaged,  // eqs (1) and (2): a bias, a discriminator and drifts as they are told
    laser,     // the four-wave laser and the phases of its beats, from which these follow
};

// Members are named as the keys of a configuration, whose sections are [gyro], [drift], [perimeter], [piezo] and [faults].
struct TwinConfig {
    std::uint64_t seed = 1;
    double tick_s = 0.005;  // bias commutation period T
    Fidelity fidelity = Fidelity::averaged;

    double scale_arcsec = 3.263;  // per count
    double bias_hz = 60e3;        // mean over a half as the counter sees it; plateau = bias_hz / (1 - bias_edge_s / T)
    double bias_chi = 3.6;        // eq (2)
    double bias_edge_s = 50e-6;   // duration of a reversal, trapezoid centred on the half's border
    int first_bias_sign = 1;
    double bias_temperature_coefficient_per_c = 0.0;
    double reference_temperature_c = 20.0;
    double temperature_rise_c = 20.0;  // T(t) = reference + rise (1 - exp(-t/thermal_time_s))

    int light_samples = 16;
    double light_noise_lambda = 0.0033;       // of one sample, as detuning
    double discriminator_per_lambda = 0.332;  // (A - B)/(A + B) per wavelength

    double magnetic_arcsec_s = 0.7;          // Om at start, eq (5); its sign follows the helicity that lases
    double magnetic_thermal_arcsec_s = 0.7;  // A
    double thermal_time_s = 3000.0;
    double nonmagnetic_arcsec_s = 0.05;
    double random_walk_arcsec_sqrt_s = 0.14;

    LoopKind loop = LoopKind::analog;
    double tau_s = 0.0065;       // of the loop
    double limit_lambda = 0.09;  // of its error signal
    double miss_lambda = 0.22;   // |detuning| at the moment of closing; 0: what comes of itself
    double expansion_lambda_per_c = 0.025;

    double half_wave_v = 40.0;                             // at the reference temperature
    double half_wave_temperature_coefficient_per_c = 0.0;  // relative; V = middle of the range is where nothing changes
    double hysteresis = 0.0;                               // width of a voltage loop over its height; 0: none
    double hysteresis_stroke_v = 300.0;                    // of that loop
    double creep_per_decade = 0.0;  // growth of a stroke per decade of time, from 10 ms to 10^4 s
    double mirror_hz = 0.0;         // resonance of the mirror; 0: rigid
    double mirror_damping = 0.05;   // of that resonance, as a part of the critical
    double rc_s = 0.001;            // of the high-voltage stage
    double slew_v_s = 4000.0;
    double range_min_v = 0.0;  // of the piezo
    double range_max_v = 300.0;
    int dac_bits = 12;
    int adc_bits = 12;
    double adc_noise_v = 0.02;
    double coil_noise_a = 0.001;  // of the coil's current as it is read, whose plateau is 1 A; 12 bits for +-2 A
    double counter_max_hz = std::numeric_limits<double>::infinity();  // faster fringes are lost

    std::vector<Fault> faults{};  // in any order
    double vibration_hz = 170.0;  // of FaultKind::vibration

    // Of `laser` alone, which in turn takes its bias, chi and discriminator from the gas and its random walk from lock-in:
    // bias_hz, bias_chi, discriminator_per_lambda and random_walk_arcsec_sqrt_s do nothing there.
    LaserConfig laser{};
    BeatConfig beats{};
};

// The averaged twin's own keys from the laser's: the mean bias over a half, edges included, in counts; chi; the slope.
[[nodiscard]] TwinConfig with_laser(TwinConfig config, const AveragedLaser& laser);

}  // namespace zlg::twin
