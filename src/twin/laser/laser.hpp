#pragma once
// Which longitudinal mode lases at a given perimeter.
//
// Modes of helicity +1 have their centres at whole wavelengths, those of helicity -1 halfway between. The nearest wins.

#include <cmath>
#include <cstdint>

namespace zlg::twin {

// At 0.25 wavelength both helicities are equally far and their light runs one way each; 0.01 on either side is where
// the four-wave equations give this overlap for a bias field of 15...20 G.
inline constexpr double two_way_limit_lambda = 0.24;

// Lengths below any rounding of the perimeter. Left to decay they would end as denormals, which are slow.
inline constexpr double negligible_lambda = 1e-30;

struct Mode {
    std::int64_t centre_half_lambda = 0;  // position of the centre in half wavelengths; its parity is the helicity
    double detuning_lambda = 0.0;         // within +-0.25

    [[nodiscard]] int helicity() const { return centre_half_lambda % 2 == 0 ? 1 : -1; }
    [[nodiscard]] bool two_way() const { return std::abs(detuning_lambda) < two_way_limit_lambda; }
};

// length_lambda  within +-1e15, so that the cast is defined.
inline Mode lasing_mode(double length_lambda) {
    const double halves = 2.0 * length_lambda;
    const auto centre = static_cast<std::int64_t>(halves + (halves < 0.0 ? -0.5 : 0.5));
    return {centre, length_lambda - 0.5 * static_cast<double>(centre)};
}

// Centre of that mode of the given helicity which is nearest to a perimeter length.
inline double nearest_centre_lambda(int helicity, double length_lambda) {
    const double shift = helicity > 0 ? 0.0 : 0.5;
    return std::round(length_lambda - shift) + shift;
}

}  // namespace zlg::twin
