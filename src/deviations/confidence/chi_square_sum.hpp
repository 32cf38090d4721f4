#pragma once
// The law of a sum of independent chi-square variables, each times its own scale.

#include <span>

#include <zlg/deviations/variance_law.hpp>

namespace zlg::deviations {

struct Tails {
    double below = 0.0;
    double above = 0.0;
};

// Probabilities that sum scale_i chi2(dof_i) is below and above x > 0: the inverse Laplace transform of
// prod (1 + 2 scale_i s)^(-dof_i/2), integrated over a parabola through the saddle point, where nothing oscillates.
//
// source  C. Helstrom, IEEE Trans. Aerosp. Electron. Syst. 32 (1996) 867
// accuracy  1e-7 of the smaller tail
[[nodiscard]] Tails tails(std::span<const ChiSquarePart> parts, double x);

// x with that much below, 0 < below < 1, and above = 1 - below, given for its digits.
[[nodiscard]] double quantile(std::span<const ChiSquarePart> parts, const Tails& probability);

}  // namespace zlg::deviations
