#pragma once
// A smooth motion, as the prior of directions in which the moments hold no information.

#include <array>

#include <zlg/core/compensation/motion_moments.hpp>

namespace zlg::core {

using TickWindow = std::array<double, window_ticks>;

// Covariance of two ticks by their distance, from that of half-ticks.
constexpr TickWindow of_ticks(const Window& halves) noexcept {
    TickWindow w{};
    for (unsigned tick = 0; tick < w.size(); ++tick) {
        const unsigned lag = 2 * tick;
        w[tick] = 2.0 * halves[lag] + (lag + 1 < halves.size() ? halves[lag + 1] : halves[lag]) +
                  halves[lag > 0 ? lag - 1 : 1];
    }
    return w;
}

// Weak prior of a learnt covariance: rates with the spectrum 1/(1 + (f/0.05)^4) + 1e-4, f in 1/tick, integrated over
// half-ticks; by distance in half-ticks, for a tick of variance 1. Band and floor by trial on recorded motion: a prior
// that is too wide loses to the constant, and without a floor the matrix is nearly singular.
inline constexpr Window smooth_prior{
    0.251624421935,    0.248375578065,    0.240671034931,    0.22918718569,     0.214930433481,    0.198767931966,
    0.181436176951,    0.163550771513,    0.14561691523,     0.128040241686,    0.111137695577,    0.0951482013605,
    0.0802429294019,   0.0665350131318,   0.0540886120035,   0.0429272504631,   0.0330413930232,   0.0243952403487,
    0.0169327514722,   0.0105829133213,   0.00526429114214,  0.000888902590385, -0.00263453532511, -0.00539793321143,
    -0.00749167487083, -0.00900292575272, -0.010014349424,   -0.0106031791206,  -0.0108405941489,  -0.0107913541792,
    -0.0105136481349,  -0.0100591182656,  -0.00947302397703, -0.00879451395927, -0.00805697903322, -0.00728846184431,
    -0.00651210303374, -0.00574660676936};

}  // namespace zlg::core
