#pragma once
// A row of errors, parted by regression: what is in phase with the motion, its noise, its rms.

#include <span>

#include "random_phase_motion.hpp"

namespace zlg::paper {

struct Estimate {
    double value = 0.0;
    double error = 0.0;  // one standard error
};

// error_k = mean + extremum sine_k + crossing cosine_k + noise_k
struct PhaseRegression {
    Estimate mean;
    Estimate extremum;
    Estimate crossing;  // 0, 0 where all cosines are 0
    double noise = 0.0;
};

// Least squares. The standard errors allow a noise that depends on the phase (White, Econometrica 48, 1980), as
// rounding does where the rate is near zero.
//
// at  as many as errors, 4 or more, with sines that are not all equal.
[[nodiscard]] PhaseRegression regress(std::span<const double> errors, std::span<const Quadratures> at);

// Root of the mean square; its standard error from the spread of the squares.
[[nodiscard]] Estimate root_mean_square(std::span<const double> errors);

}  // namespace zlg::paper
