#pragma once
// The covariance of the rows of a window, before anything that was not learnt: C, E and D R D^T of switch_estimate.hpp.

#include <array>

#include <zlg/core/compensation/compensation_constants.hpp>

#include <zlg/core/common/triangle.hpp>
#include <zlg/core/compensation/switch_window.hpp>

namespace zlg::core {

// What the readings of the rows are, beside their covariance.
struct WindowReadings {
    double rate_arcsec = 0.0;                             // mean of the points, a half
    std::array<double, most_window_rows> false_arcsec{};  // d of each row, by the configured chi f0
    std::array<double, most_window_rows> angle_arcsec{};  // y + (1 + scale) d
};

// C: the learnt covariance, of which the roundings that the moments hold are taken out, as large a share as leaves it positive.
//
// into  receives it.
// trial a second room, of no account after.
void learnt_covariance(const CompensationConstants& gyro, const SwitchWindow& window, const MotionMoments& motion,
                       Triangle into, Triangle trial) noexcept;

// E, and the readings.
//
// return  what the light says of false angles; not known: none are corrected.
void error_covariance(const CompensationConstants& gyro, const SwitchWindow& window, const RelockScale& scale,
                      WindowReadings& readings, Triangle into) noexcept;

// D R D^T.
//
// motion, errors  C and E: how far the place of a reading scatters.
void rounding_covariance(const CompensationConstants& gyro, const SwitchWindow& window, const WindowReadings& readings,
                         double scale, Triangle motion, Triangle errors, Triangle into) noexcept;

}  // namespace zlg::core
