#pragma once
// One line of a design: of a substitution, or of the perimeter loop.

#include <string>
#include <vector>

#include <zlg/design/initial_miss.hpp>
#include <zlg/design/perimeter_response.hpp>
#include <zlg/design/relock_loop.hpp>

namespace zlg::study {

struct SubstitutionLine {
    int order = 0;
    int gap_ticks = 0;
    double frequency_hz = 0.0;    // NaN: all the configured motion together
    double worst_arcsec = 0.0;    // final error of the gap's angle, at the worst phase
    double rms_arcsec = 0.0;      // over random phase
    double noise_gain = 0.0;      // white noise: sigma of the gap's angle over that of a tick
    double counter_arcsec = 0.0;  // sigma of the gap's angle by rounding of the counter
    double relock_arcsec = 0.0;   // what re-lock leaves in the angle, directly and through the points after the gap
    double total_arcsec = 0.0;    // eq (19) with that residual: root sum square of rms, rounding and re-lock
};

struct LoopLine {
    design::PerimeterLoop loop;
    design::Margins margins;
    double tick_over_tau = 0.0;
    double stability_limit = 0.0;              // of tick_over_tau, for the detector that is sampled
    std::string stability_note;                // which detector that is
    std::string relock_note;                   // why there is no time of re-lock; empty where there is one
    double relock_from_lambda = 0.0;           // the configured miss; where that is 0, the one that comes of itself
    double relock_s = 0.0;                     // from there to a hundredth of a wavelength
    std::vector<double> false_drift_arcsec_s;  // per tick after closing
    double false_angle_arcsec = 0.0;
    double false_angle_law_arcsec = 0.0;  // (T/4) G(0+)
    design::InitialMiss miss;
    double capture_lambda = 0.5;  // a detector of two modes pulls in from everywhere between them
};

}  // namespace zlg::study
