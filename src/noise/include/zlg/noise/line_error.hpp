#pragma once
// What the noise of a gyro that walks does to the straight line through the stages of a rate table.
//
// Stages follow each other in time, so that a walk of the rate makes neighbours alike: on a table that goes from the
// lowest to the highest rate it looks like a scale factor, on any the scatter about the line tells less than
// independent stages would. The error of the slope is the root mean square of what the slope by ordinary least squares
// and the truth differ by, averaged over white noise and walks by their restricted likelihood; the degrees of freedom
// of the variance about the line are those of Satterthwaite (Biometrics Bulletin 2, 1946), (tr C)^2/tr C^2 of the
// residuals' covariance C, averaged as 1/degrees.

#include <span>

namespace zlg::noise {

struct LineError {
    double slope_sigma = 0.0;  // scale of a Student law of n - 2 degrees
    double degrees = 0.0;      // of the variance about the line; n - 2 for independent stages
};

// input   at least three, not all the same, of stages of like length in the order of time.
// output  as many. The time goes with their cube: 1000 take some seconds.
[[nodiscard]] LineError line_error(std::span<const double> input, std::span<const double> output);

}  // namespace zlg::noise
