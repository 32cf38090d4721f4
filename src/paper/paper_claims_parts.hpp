#pragma once
// The checked claims of the paper, by the part of it in which they stand.
//
// A verdict is on the paper, so every number in a finding is computed for the paper's own gyro, which is the default
// configuration, whatever gyro the rest of the page is for.

#include <initializer_list>
#include <vector>

#include <zlg/design/substitution_noise.hpp>

#include "paper_trial.hpp"
#include "paper_words.hpp"

namespace zlg::paper {

// Error of a gap at the worst phase of the oscillation, and the gain of white noise, of this fit and order.
[[nodiscard]] inline double worst_arcsec(design::Fit fit, int order, int n = paper_gap_ticks) {
    return design::worst(design::ErrorResponse({fit, order, n}), paper_oscillation).error_arcsec;
}
[[nodiscard]] inline double noise_gain(design::Fit fit, int order) {
    return design::sum_gain({fit, order, paper_gap_ticks}, design::TickNoise::white);
}

using Findings = std::vector<Finding> (*)();

[[nodiscard]] std::vector<Finding> joined(std::initializer_list<Findings> parts);

[[nodiscard]] std::vector<Finding> claims_of_drift();         // eqs (3) to (9), figures 3 to 5
[[nodiscard]] std::vector<Finding> claims_of_relock();        // eqs (10) to (13), tables 1 and 2
[[nodiscard]] std::vector<Finding> claims_of_substitution();  // eqs (14) to (20), figures 6 to 11

}  // namespace zlg::paper
