#pragma once
// Which waves are lit where: two of one mode, a third of its neighbour, four, one in each mode, none.

#include <vector>

#include <zlg/twin/four_wave.hpp>

namespace zlg::twin {

// A stretch of the perimeter with the same waves lit.
struct LaserZone {
    double from_lambda = 0.0;
    double to_lambda = 0.0;
    unsigned lit = 0;  // as LaserLight::lit

    [[nodiscard]] bool dark() const { return lit == 0; }
    // A wave of the right mode is lit.
    [[nodiscard]] bool right_lit() const { return (lit & 12U) != 0; }
    // Light, but of no mode in both directions.
    [[nodiscard]] bool one_way() const { return !dark() && (lit & 3U) != 3U && (lit & 12U) != 12U; }
};

// The zones from one perimeter to another in their order; they cover the stretch without holes.
//
// accuracy  edges 1e-9 wavelength; a zone narrower than 1e-4 may be missed where the same waves are lit on both sides.
// errors    std::invalid_argument unless from < to <= from + 10, both within +-1e6, and the field is finite.
// cost      about 15 ms a wavelength.
[[nodiscard]] std::vector<LaserZone> laser_zones(const FourWave& laser, double field_g, double from_lambda,
                                                 double to_lambda);

}  // namespace zlg::twin
