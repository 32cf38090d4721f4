#pragma once
// The section [laser] of a configuration: cavity, gas, field, mirrors and counter of a gyro of fidelity `laser`.

namespace zlg::twin {

// The counter of both detectors, which are a quarter of a turn of the beat apart: counts a turn.
enum class Quadrature { x1, x4 };

[[nodiscard]] constexpr int counts_per_turn(Quadrature quadrature) { return quadrature == Quadrature::x4 ? 4 : 1; }

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

    double zeeman_hz_per_g = 1.82e6;  // shift of one circular component
    // Cross-saturation of waves on opposite components; same component: 1. Up to 1 the waves have one steady state;
    // above, which of several would depend on the past.
    double opposite_sigma_coupling = 0.6;
    double bias_field_g = 15.0;  // plateau of the square bias; its sign alternates

    // Light that either beam loses in all, at zero detuning and field; 0: no quantum noise. 0.28 saturation intensities
    // of 20 W/cm2 in a beam of 0.25 mm, pi w^2/2 wide, times the loss.
    double beam_power_w = 39e-6;

    double lock_in_left_hz = 150.0;  // beat frequency below which equal waves lock, of either helicity
    double lock_in_right_hz = 150.0;
    // eps: by how much the waves scattered back miss each other's phase. At a quarter of a turn equal mirrors do not
    // lock equal waves, whatever they scatter.
    double scatter_phase_deg = 0.0;
    double comparator_threshold = 0.1;  // in parts of the beat's amplitude at zero detuning and zero field
    Quadrature quadrature = Quadrature::x1;
};

// Less would blur a turn within a half.
inline constexpr double min_beam_power_w = 1e-12;

// Random walk of the beat by the spontaneous emission of both beams, in turns over the root of a second; 0 without.
//
//   FSR mu/(2 pi) sqrt(h nu/P)
//
// source  A. L. Schawlow, C. H. Townes, Phys. Rev. 112 (1958) 1940: a beam's line is pi h nu (FSR mu/(2 pi))^2/P wide
//         above threshold and its phase spreads by 2 pi times that in a second.
[[nodiscard]] double quantum_walk_turns(const LaserConfig& config);

// Refuse members that do not make a gas: lines that no table can hold, and gain that lets a third mode lase.
// Each member for itself is within the range of its key.
//
// errors  std::invalid_argument: the key that the member has in a configuration, value, allowed.
void validate(const LaserConfig& config);

}  // namespace zlg::twin
