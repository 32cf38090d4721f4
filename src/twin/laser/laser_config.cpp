#include <zlg/twin/laser_config.hpp>

#include <algorithm>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "gas.hpp"

namespace zlg::twin {
namespace {

[[noreturn]] void refuse(const char* key, double value, const std::string& allowed) {
    throw std::invalid_argument(fmt::format("{} is {}, allowed is {}", key, value, allowed));
}

void require_within(const char* key, double value, double min, double max) {
    if (!(value >= min && value <= max)) refuse(key, value, fmt::format("{}..{}", min, max));
}

}  // namespace

void validate(const LaserConfig& c) {
    require_within("laser.perimeter_m", c.perimeter_m, 1e-3, 1e3);
    require_within("laser.round_trip_loss_ratio", c.round_trip_loss_ratio, 1e-9, 0.5);
    require_within("laser.gain_loss_ratio", c.gain_loss_ratio, 1e-6, 100.0);
    require_within("laser.doppler_half_width_hz", c.doppler_half_width_hz, 1e6, 1e12);
    // Narrower lines would need finer tables than a gyro is worth; wider ones are no Doppler gas.
    require_within("laser.homogeneous_half_width_hz", c.homogeneous_half_width_hz, 0.01 * c.doppler_half_width_hz,
                   10.0 * c.doppler_half_width_hz);
    require_within("laser.isotope_shift_hz", c.isotope_shift_hz, 0.0, 10.0 * c.doppler_half_width_hz);
    require_within("laser.upper_isotope_ratio", c.upper_isotope_ratio, 0.0, 1.0);
    require_within("laser.zeeman_hz_per_g", c.zeeman_hz_per_g, 0.0, c.doppler_half_width_hz);
    // Up to 1 the waves have one steady state; above, which of several would depend on the past.
    require_within("laser.opposite_sigma_coupling", c.opposite_sigma_coupling, 0.0, 1.0);
    require_within("laser.bias_field_g", c.bias_field_g, 0.0, 1e4);
    const Gas gas{c};
    const double second_neighbour = std::max(gas.gain_loss(0.5), gas.gain_loss(-0.5));
    if (!(second_neighbour < 1.0)) {
        refuse("laser.gain_loss_ratio", c.gain_loss_ratio,
               fmt::format("below {:.4g} in a ring of {:.4g} m, where both neighbours of a centred mode have gain",
                           c.gain_loss_ratio / second_neighbour, c.perimeter_m));
    }
}

void validate(const BeatConfig& c) {
    require_within("laser.lock_in_left_hz", c.lock_in_left_hz, 0.0, 1e6);
    require_within("laser.lock_in_right_hz", c.lock_in_right_hz, 0.0, 1e6);
    // At a quarter of a turn equal mirrors do not lock equal waves, whatever they scatter.
    require_within("laser.scatter_phase_deg * pi/180", c.scatter_phase_rad, -1.5, 1.5);
    require_within("laser.comparator_threshold", c.comparator_threshold, 0.0, 0.5);
    if (c.counts_per_turn != 1 && c.counts_per_turn != 4) refuse("laser.quadrature", c.counts_per_turn, "1 or 4");
}

}  // namespace zlg::twin
