#pragma once
// The covariance of a motion that the configuration knows beforehand.

#include <zlg/config/config.hpp>
#include <zlg/core/compensation/motion_moments.hpp>

namespace zlg::rig {

// Covariance of the angles of two half-ticks of h = T/2 by their distance k, arcsec^2.
//
//   a line of amplitude a at f:  (a^2/2) h^2 sinc^2(f h) cos(2 pi f h k);   a flat band: the mean of it over 0..band
[[nodiscard]] core::Window motion_prior(const config::Compensation& compensation, double tick_s);

}  // namespace zlg::rig
