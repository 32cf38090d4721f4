#pragma once
// What a gyro is: the sections of a configuration that describe it, one struct a section, one member a key.
//
// The configuration has these structs as its sections, or derives from them to add what only the processor needs to
// know; the table of keys holds the range of each. The defaults are the gyro of the paper.

#include <vector>

#include <zlg/twin/environment_config.hpp>

namespace zlg::twin {

enum class Fidelity {
    averaged,  // eqs (1) and (2): bias, discriminator and drifts as configured
    laser,     // the four-wave laser and the phases of its beats, from which these follow
    events,    // `averaged` around every event; between two, by its laws (leap.hpp)
};

// Who closes the perimeter loop.
enum class Loop {
    analog,       // electronics: integrator with a limiter, then the high-voltage stage
    exponential,  // the paper's idealisation, eq (10): detuning decays with tau from the moment of closing
    digital,      // the processor: its set-points rule, whether the loop is closed or open
};

// What is latched of the beat.
enum class Readout {
    counts,  // the counter alone
    phase,   // both photodiodes beside it: the place within the fringe
};

// [gyro]
struct GyroConfig {
    Fidelity fidelity = Fidelity::averaged;
    double tick_s = 0.005;        // bias commutation period T
    double scale_arcsec = 3.263;  // per count
    double bias_hz = 60e3;        // mean over a half, edges included, at zero detuning and reference temperature
    double bias_chi = 3.6;        // eq (2)
    std::vector<double> bias_chi_higher = {};  // loss by dl^4, dl^6, dl^8
    double bias_edge_s = 50e-6;                // duration of a reversal, trapezoid centred on the half's border
    int first_bias_sign = 1;
    double reference_temperature_c = 20.0;
    double temperature_rise_c = 20.0;  // T(t) = reference + rise (1 - exp(-t/drift.thermal_time_s))
    double bias_temperature_coefficient_per_c = 0.0;
    CourseConfig bias_temperature_table;  // C and relative change of the bias, in place of that law; none: that law
    int light_samples = 16;
    double light_noise_lambda = 0.0033;       // of one sample, as detuning
    double discriminator_per_lambda = 0.332;  // (A - B)/(A + B) of the two beams per wavelength of detuning
    Readout readout = Readout::counts;
};

// [light]: the photodiodes of the two beams, and the power that they see. In units of the mean light of beam A at t =
// 0:
//
//   A' = A p + offset_a,  B' = B p gain_b (1 + gain_drift t) + offset_b,  p = exp(-power_decay t)
struct LightConfig {
    double gain_b = 1.03;             // of the photodiode of beam B over that of A, at t = 0
    double gain_drift_per_h = 0.005;  // of that, relative
    double offset_a = 0.0;
    double offset_b = 0.0;
    double power_decay_per_h = 0.01;
};

// What theory is held against.
inline constexpr LightConfig equal_light{.gain_b = 1.0, .gain_drift_per_h = 0.0, .power_decay_per_h = 0.0};

// Of the converter of the photodiodes of the beat, over the beat's amplitude at the centre; both signs.
inline constexpr double photodiode_range = 2.0;

// [photodiodes]: those of the beat, in parts of its amplitude at the centre.
struct PhotodiodesConfig {
    double offset_cosine = 0.03;
    double offset_sine = -0.03;
    double amplitude_error = 0.03;  // of the sine's over the cosine's, less 1
    double angle_error_deg = 3.0;   // by which the sine's is more than a quarter of a turn ahead
    double noise = 0.01;            // of one sample, rms, white
    int adc_bits = 12;              // for +-2
    double skew_s = 0.0;            // from the latch to the sampling
    double jitter_s = 0.0;          // of that, rms
};

// [drift]
struct DriftConfig {
    double magnetic_arcsec_s = 0.7;          // Om at start, eq (5); its sign follows the helicity that lases
    double magnetic_thermal_arcsec_s = 0.7;  // A: added A (1 - exp(-t/thermal_time_s))
    double thermal_time_s = 3000.0;
    double nonmagnetic_arcsec_s = 0.05;
    double random_walk_arcsec_sqrt_s = 0.14;
};

// [perimeter]
struct PerimeterConfig {
    Loop loop = Loop::analog;
    double tau_s = 0.0065;       // of the loop; 1e-6 or more, for less is too stiff for the steps of the twin
    double limit_lambda = 0.09;  // of its error signal
    double miss_lambda = 0.22;   // |detuning| at the moment of closing; 0: what the simulated switch leaves
    double expansion_lambda_per_c = 0.025;
};

// [piezo]
struct PiezoConfig {
    double half_wave_v = 40.0;  // at the reference temperature
    // Relative; at the middle of the voltage range the length does not change.
    double half_wave_temperature_coefficient_per_c = 0.0;
    double rc_s = 0.001;  // of the high-voltage stage
    double slew_v_s = 4000.0;
    double range_min_v = 0.0;
    double range_max_v = 300.0;
    // Width of a loop of stroke hysteresis_stroke_v over its height; 0: none. Up to 0.4, which is as far as the play
    // operators of the model go.
    double hysteresis = 0.0;
    double hysteresis_stroke_v = 300.0;
    // Growth of a stroke per decade of time, from 10 ms to 10^4 s; 0: none. Beyond 0.05 it would rival the stroke
    // itself.
    double creep_per_decade = 0.0;
    double mirror_hz = 0.0;        // resonance of the mirror; 0: rigid
    double mirror_damping = 0.05;  // of that resonance, as a part of the critical
    int dac_bits = 12;
    int adc_bits = 12;
    double adc_noise_v = 0.02;
};

}  // namespace zlg::twin
