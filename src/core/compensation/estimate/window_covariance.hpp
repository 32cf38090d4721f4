#pragma once
// The covariance of the rows of a window, before anything that was not learnt: C, E and D R D^T of switch_estimate.hpp.

#include <array>

#include <zlg/core/common/triangle.hpp>
#include <zlg/core/compensation/compensation_constants.hpp>
#include <zlg/core/compensation/light_spline.hpp>
#include <zlg/core/compensation/switch_estimate.hpp>

namespace zlg::core {

// What the readings of the rows are, beside their covariance.
struct WindowReadings {
    double rate_arcsec = 0.0;                             // mean of the points, a half
    std::array<double, most_window_rows> false_arcsec{};  // d of each row, by the configured chi f0
    std::array<double, most_window_rows> angle_arcsec{};  // y + (1 + scale) d
};

// C: the learnt covariance, of which the roundings that the moments hold are taken out, as large a share as leaves it
// positive.
//
// into  receives it, of all rows.
void learnt_covariance(const CompensationConstants& gyro, const SwitchWindow& window, const MotionMoments& motion,
                       Triangle into) noexcept;

// E of the points.
class ReadingErrors {
public:
    // halves    room to work in, for as long as this is used.
    // readings  receives what the light says, and what follows.
    ReadingErrors(const CompensationConstants& gyro, const SwitchWindow& window, const RelockScale& scale,
                  LightHalves& halves, WindowReadings& readings) noexcept;

    // Of two rows that were read.
    [[nodiscard]] double of(int r, int s) const noexcept;

private:
    [[nodiscard]] Stretch lit_part(const WindowRow& row) const noexcept;

    const SwitchWindow& window_;
    const RelockScale& scale_;
    const WindowReadings& readings_;
    const LightFit light_;
    LightHalves& halves_;                            // with the sign of the bias, of each row in turn
    std::array<Stretch, most_window_rows> forms_{};  // which are those of a row
    double unit_arcsec_ = 0.0;
    double bias_arcsec2_ = 0.0;
};

// The law of the counter's roundings: the covariance of two readings of a free-running counter.
//
// A reading is the whole part of a phase. Its rounding error is uniform over a count, and two readings between which
// the phase turned by x counts, Gaussian with the variance s^2, have the covariance
//
//   R(x, s^2) = (x^2 - x + 1/6)/2 exp(-2 pi^2 s^2),    x modulo 1                      [counts^2]
//
// the second Bernoulli polynomial, of whose Fourier series sum cos(2 pi k x)/(2 pi^2 k^2) the scatter leaves the first
// term. Source: Widrow and Kollar, Quantization Noise, 2008, ch. 4 and 9.
//
// turn_counts  of which no fraction is known beyond 2^51: taken for whole there.
// return       0 beyond a scatter of 2 counts^2, where the factor is below 1e-17.
[[nodiscard]] double rounding_law(double turn_counts, double scatter_counts2) noexcept;

// V = C + E + D R D^T.
//
// v  C + E, of all rows; receives V.
void add_roundings(const CompensationConstants& gyro, const SwitchWindow& window, const WindowReadings& readings,
                   double scale, Triangle v) noexcept;

}  // namespace zlg::core
