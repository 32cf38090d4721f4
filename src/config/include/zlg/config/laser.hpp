#pragma once
// The section [laser] of a configuration.

namespace zlg::config {

enum class Quadrature { x1, x4 };

// The gas, the mirrors and the counter of a gyro of fidelity `laser`.
struct Laser {
    double perimeter_m = 0.160;
    double round_trip_loss_ratio = 0.007;
    double gain_loss_ratio = 1.20;
    double doppler_half_width_hz = 907e6;
    double homogeneous_half_width_hz = 130e6;
    double isotope_shift_hz = 885e6;
    double upper_isotope_ratio = 0.5;
    double zeeman_hz_per_g = 1.82e6;
    double opposite_sigma_coupling = 0.6;
    double bias_field_g = 15.0;
    double lock_in_left_hz = 150.0;
    double lock_in_right_hz = 150.0;
    double scatter_phase_deg = 0.0;
    double comparator_threshold = 0.1;
    Quadrature quadrature = Quadrature::x1;
};

}  // namespace zlg::config
