#include <zlg/twin/laser_config.hpp>

#include <cmath>
#include <numbers>

#include "gas.hpp"
#include "light.hpp"
#include "refusal.hpp"

namespace zlg::twin {

namespace {

// Whether, while a centred mode and its neighbour lase without field, the neighbour on the other side has gain to
// spare. Of the holes that take from it only those of the centred mode are counted, which are less.
bool third_mode_lases(const LaserConfig& c) {
    const Gas gas{c};
    for (const double side : {0.5, -0.5}) {
        const Balance lit = steady_state(gas.at(0.0, -side, 0.0).competition);
        const Competition beyond = gas.at(0.0, side, 0.0).competition;
        for (const unsigned i : {2U, 3U}) {
            double spare = beyond.net_gain[i];
            for (unsigned j = 0; j < 2; ++j)
                if (lit.lit >> j & 1U) spare -= beyond.saturation[i][j] * lit.value[j];
            if (!(spare < 0.0)) return true;
        }
    }
    return false;
}

// Where the next mode begins to lase.
double largest_gain_loss(LaserConfig c) {
    double low = 1.0;
    double high = c.gain_loss_ratio;
    while (high - low > 1e-4 * high) {
        c.gain_loss_ratio = 0.5 * (low + high);
        (third_mode_lases(c) ? high : low) = c.gain_loss_ratio;
    }
    return low;
}

}  // namespace

double quantum_walk_turns(const LaserConfig& c) {
    constexpr double planck_j_s = 6.62607015e-34;
    if (!(c.beam_power_w > 0.0)) return 0.0;
    return light_m_s / c.perimeter_m * c.round_trip_loss_ratio / (2.0 * std::numbers::pi) *
           std::sqrt(planck_j_s * light_m_s / wavelength_m / c.beam_power_w);
}

void validate(const LaserConfig& c) {
    // Narrower lines would need finer tables than a gyro is worth; wider ones are no Doppler gas.
    require_within("laser.homogeneous_half_width_hz", c.homogeneous_half_width_hz, 0.01 * c.doppler_half_width_hz,
                   10.0 * c.doppler_half_width_hz);
    require_within("laser.isotope_shift_hz", c.isotope_shift_hz, 0.0, 10.0 * c.doppler_half_width_hz);
    require_within("laser.zeeman_hz_per_g", c.zeeman_hz_per_g, 0.0, c.doppler_half_width_hz);
    if (c.beam_power_w != 0.0 && !(c.beam_power_w >= min_beam_power_w))
        refuse("laser.beam_power_w", c.beam_power_w, fmt::format("0 or >= {}", min_beam_power_w));
    if (third_mode_lases(c)) {
        refuse(
            "laser.gain_loss_ratio", c.gain_loss_ratio,
            fmt::format("below {:.4g} in a ring of {:.4g} m with this gas, where a third mode lases beside the nearest "
                        "two",
                        largest_gain_loss(c), c.perimeter_m));
    }
}

}  // namespace zlg::twin
