#pragma once
// What a trial of accuracy presumes: how the case moves, and how the gyro that watches it is made.

#include <array>
#include <vector>

namespace zlg::trials {

struct Tone {
    double frequency_hz = 0.0;
    double amplitude_arcsec_s = 0.0;
};

// Random motion with a flat spectrum between two frequencies.
struct Band {
    double low_hz = 0.0;
    double high_hz = 0.0;
    double rms_arcsec_s = 0.0;
};

// Shocks at random times, a Poisson process: the rate rings as exp(-t/decay) sin(2 pi ring t), of random sign.
struct Shocks {
    double per_s = 0.0;
    double rate_arcsec_s = 0.0;
    double ring_hz = 0.0;
    double decay_s = 1.0;
};

struct MotionLaw {
    double rate_arcsec_s = 0.0;         // constant
    double rate_spread_arcsec_s = 0.0;  // of each gyro its own: uniform within this on either side
    std::vector<Tone> tones;            // of random phase
    std::vector<Band> bands;
    Shocks shocks;
};

// How the detuning decays once the loop is closed.
enum class LoopShape { exponential, slew, second_order, underdamped, dead_time };
inline constexpr std::array loop_shapes{LoopShape::exponential, LoopShape::slew, LoopShape::second_order,
                                        LoopShape::underdamped, LoopShape::dead_time};

// Both photodiodes of the beat: their errors, and the noise and the converter with which they are read.
struct PhotodiodeLaw {
    bool reads = false;   // false: whole counts
    bool learnt = false;  // their ellipse is known at the first half, as where a log begins in a gyro that has run
    double offset_cosine = 0.1;
    double offset_sine = -0.1;
    double amplitude_error = 0.1;
    double angle_error_deg = 5.0;
    double noise = 0.01;
    int adc_bits = 12;
};

struct GyroLaw {
    double tick_s = 0.005;
    double scale_arcsec = 3.263;
    double bias_hz = 60e3;
    double chi = 3.6;
    double chi_error_ratio = 0.0;  // true chi over the one that compensation presumes, less one
    double miss_lambda = 0.22;
    double light_noise_lambda = 0.0033;
    int light_samples = 16;
    int gap_ticks = 3;
    LoopShape loop = LoopShape::slew;
    double magnetic_arcsec_s = 0.0;  // drift that changes its sign with the helicity, at the start
    double magnetic_thermal_arcsec_s = 0.0;
    double thermal_time_s = 3000.0;
    double random_walk_arcsec_sqrt_s = 0.0;  // of the angle that is read, beyond the rotation
    int lit_halves = 0;  // at the end of a gap: the light is back, the loop still open, the detuning that of the miss
    PhotodiodeLaw photodiodes;
};

}  // namespace zlg::trials
