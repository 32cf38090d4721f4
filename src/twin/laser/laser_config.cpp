#include <zlg/twin/laser_config.hpp>

#include <algorithm>

#include "gas.hpp"
#include "refusal.hpp"

namespace zlg::twin {

void validate(const LaserConfig& c) {
    // Narrower lines would need finer tables than a gyro is worth; wider ones are no Doppler gas.
    require_within("laser.homogeneous_half_width_hz", c.homogeneous_half_width_hz, 0.01 * c.doppler_half_width_hz,
                   10.0 * c.doppler_half_width_hz);
    require_within("laser.isotope_shift_hz", c.isotope_shift_hz, 0.0, 10.0 * c.doppler_half_width_hz);
    require_within("laser.zeeman_hz_per_g", c.zeeman_hz_per_g, 0.0, c.doppler_half_width_hz);
    const Gas gas{c};
    const double second_neighbour = std::max(gas.gain_loss(0.5), gas.gain_loss(-0.5));
    if (!(second_neighbour < 1.0)) {
        refuse("laser.gain_loss_ratio", c.gain_loss_ratio,
               fmt::format("below {:.4g} in a ring of {:.4g} m, where both neighbours of a centred mode have gain",
                           c.gain_loss_ratio / second_neighbour, c.perimeter_m));
    }
}

}  // namespace zlg::twin
