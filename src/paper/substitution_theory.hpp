#pragma once
// Theory of one fit of one experiment on the substitution of a gap: the response of the fit to the oscillation
// (design::ErrorResponse), and its noise by the covariance of what it is made of. Roundings of a counter are uniform
// and correlated by the motion between the readings (Widrow and Kollar, Quantization Noise, 2008).

#include <zlg/paper/substitution_experiment.hpp>

#include "random_phase_motion.hpp"

namespace zlg::paper {

struct SubstitutionTheory {
    double extremum_arcsec = 0.0;
    double crossing_arcsec = 0.0;
    double mean_arcsec = 0.0;
    double noise_arcsec = 0.0;  // standard deviation about motion and mean, the magnetic drift of either sign included
    double rms_arcsec = 0.0;
};

// errors  design::DesignError as design::sum_weights.
[[nodiscard]] SubstitutionTheory substitution_theory(const SubstitutionExperiment& experiment, const SwitchGrid& grid,
                                                     design::Fit fit, int order);

}  // namespace zlg::paper
