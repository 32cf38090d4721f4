#pragma once
// The digital twin: a Zeeman laser gyro, one half-period at a time.
//
// It obeys actuator frames and answers with sensor frames, and tells beside them the truth that no gyro knows.

#include <cstdint>
#include <memory>
#include <vector>

#include <zlg/core/records.hpp>
#include <zlg/twin/motion.hpp>

namespace zlg::twin {

// Who closes the perimeter loop.
enum class LoopKind {
    analog,       // electronics: integrator with a limiter, then the high-voltage stage
    exponential,  // the paper's idealisation, eq (10): detuning decays with tau from the moment of closing
    external,     // nobody here: the set-points of the processor rule, closed or open
};

struct TwinConfig {
    std::uint64_t seed = 1;
    double tick_s = 0.005;  // bias commutation period T

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
    double loop_tau_s = 0.0065;
    double loop_limit_lambda = 0.09;
    double miss_lambda = 0.22;  // |detuning| at the moment of closing; 0: what comes of itself
    double expansion_lambda_per_c = 0.025;

    double half_wave_v = 40.0;                             // at the reference temperature
    double half_wave_temperature_coefficient_per_c = 0.0;  // relative; V = middle of the range is where nothing changes
    double high_voltage_rc_s = 0.001;
    double slew_v_s = 4000.0;
    double piezo_min_v = 0.0;
    double piezo_max_v = 300.0;
    int dac_bits = 12;
    int adc_bits = 12;
    double adc_noise_v = 0.02;
};

// What happened in one half-period.
struct TwinTruth {
    double dtheta_arcsec = 0.0;        // rotation of the case
    double false_relock_arcsec = 0.0;  // angle that the detuning's effect on the bias adds to this half's counts
    double detuning_end_lambda = 0.0;  // of the mode that lases, at the end of the half
    double perimeter_v = 0.0;          // true piezo voltage at the end of the half
    bool lit = true;                   // light in both directions throughout the half
};

struct TwinHalf {
    core::SensorFrame sensor;
    TwinTruth truth;
};

class Twin {
public:
    // errors  std::invalid_argument with the offending member's name and value.
    Twin(const TwinConfig& config, Motion motion);
    ~Twin();
    Twin(Twin&&) noexcept;
    Twin& operator=(Twin&&) noexcept;

    // Live through the next half-period under `actuator`. The loop counts as closed before the first one.
    //
    // Its edge_offset_ticks is not obeyed: it acts on optical phases, which this averaged model does not have.
    // errors  std::invalid_argument for a frame that hardware could not obey; std::overflow_error where a half brings
    //         more fringes than 64 bits tell.
    // cost    about 1 us with 16 light samples; no allocation.
    TwinHalf advance(const core::ActuatorFrame& actuator);

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace zlg::twin
