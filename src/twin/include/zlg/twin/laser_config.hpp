#pragma once
// What the laser of a gyro is made of: cavity, gas, field, mirrors and counter.

namespace zlg::twin {

// Neon of two isotopes at 632.8 nm in a non-planar ring, whose modes of opposite helicity lie half a free spectral
// range apart. Each default is that of a gyro with a perimeter of 16 cm.
struct LaserConfig {
    double perimeter_m = 0.160;
    double round_trip_loss_ratio = 0.007;
    double gain_loss_ratio = 1.20;  // unsaturated, at zero detuning and zero field

    double doppler_half_width_hz = 907e6;      // where the velocity distribution falls to 1/e
    double homogeneous_half_width_hz = 130e6;  // where a Lorentzian falls to 1/2
    double isotope_shift_hz = 885e6;           // between the two line centres; detuning counts from midway
    double upper_isotope_ratio = 0.5;          // share of the isotope with the higher frequency, neon 22

    double zeeman_hz_per_g = 1.82e6;       // shift of one circular component
    double opposite_sigma_coupling = 0.6;  // cross-saturation of waves on opposite components; same component: 1
    double bias_field_g = 15.0;            // plateau of the square bias; its sign alternates
};

// What turns the light of both directions into counts.
struct BeatConfig {
    double lock_in_left_hz = 150.0;  // beat frequency below which equal waves lock, of either helicity
    double lock_in_right_hz = 150.0;
    double scatter_phase_rad = 0.0;     // eps: by how much the waves scattered back miss each other's phase
    double comparator_threshold = 0.1;  // in parts of the beat's amplitude at zero detuning and zero field
    int counts_per_turn = 1;            // of the quadrature counter: 1 or 4; the scale of the twin is that of a count
};

// Refuse what the arithmetic cannot carry, and gas in which more than two neighbouring modes have gain.
//
// errors  std::invalid_argument: the key that the member has in a configuration, value, allowed.
void validate(const LaserConfig& config);

// errors  std::invalid_argument: the key that the member has in a configuration, value, allowed.
void validate(const BeatConfig& config);

}  // namespace zlg::twin
