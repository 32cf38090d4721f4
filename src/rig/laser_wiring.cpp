#include "laser_wiring.hpp"

#include <numbers>

namespace zlg::rig {

int counts_per_fringe(const config::Config& config) {
    return config.laser.quadrature == config::Quadrature::x4 ? 4 : 1;
}

twin::LaserConfig laser_of(const config::Laser& l) {
    return {.perimeter_m = l.perimeter_m,
            .round_trip_loss_ratio = l.round_trip_loss_ratio,
            .gain_loss_ratio = l.gain_loss_ratio,
            .doppler_half_width_hz = l.doppler_half_width_hz,
            .homogeneous_half_width_hz = l.homogeneous_half_width_hz,
            .isotope_shift_hz = l.isotope_shift_hz,
            .upper_isotope_ratio = l.upper_isotope_ratio,
            .zeeman_hz_per_g = l.zeeman_hz_per_g,
            .opposite_sigma_coupling = l.opposite_sigma_coupling,
            .bias_field_g = l.bias_field_g};
}

twin::BeatConfig beats_of(const config::Config& config) {
    const config::Laser& l = config.laser;
    return {.lock_in_left_hz = l.lock_in_left_hz,
            .lock_in_right_hz = l.lock_in_right_hz,
            .scatter_phase_rad = l.scatter_phase_deg * std::numbers::pi / 180.0,
            .comparator_threshold = l.comparator_threshold,
            .counts_per_turn = counts_per_fringe(config)};
}

}  // namespace zlg::rig
