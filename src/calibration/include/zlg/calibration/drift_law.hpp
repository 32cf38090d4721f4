#pragma once
// Drift of a gyro at rest: the part that follows the helicity, with eq (5), the part that does not, and the random
// walk.
//
//   dtheta/dt = mode (Om0 + A (1 - exp(-t/tau))) + Om_nm + rate        t since the first half of a log
//
// Generalised least squares on angles between borders of settled pieces, the walk by restricted maximum likelihood (see
// increment_fit.hpp), tau by separable least squares: each border is rounded once (scale^2/12), the angle between
// walks. Om0 is the drift when the log begins; A and tau are separated only where the log bends, so they are refused
// where it is straight, and Om0 is then the mean over all warmings that may be. The non-magnetic part is all that does
// not change sign with the mode, the rotation of the Earth included, less the rate that is given as known.
//
// Where the field B(t) of every log is known, the part that follows the helicity is S (1 + beta (T_c - T_ref)) B(t) in
// place of Om0, A and tau.

#include <cstdint>
#include <functional>
#include <span>

#include <zlg/calibration/angle_scatter.hpp>
#include <zlg/calibration/bias_law.hpp>
#include <zlg/calibration/lab_log.hpp>
#include <zlg/numeric/estimate.hpp>

namespace zlg::calibration {

// Of a faster one a piece of a log holds whole periods, which tell nothing.
inline constexpr double fastest_field_hz = 1.0;

// Gauss at a time since the first half of a log.
using FieldCourse = std::function<double(double)>;

struct DriftLaw {
    numeric::Estimate sensitivity_arcsec_s_g;
    numeric::Estimate sensitivity_per_c;
    numeric::Estimate magnetic_arcsec_s;
    numeric::Estimate magnetic_thermal_arcsec_s;
    numeric::Estimate thermal_time_s;
    numeric::Estimate nonmagnetic_arcsec_s;
    numeric::Estimate random_walk_arcsec_sqrt_s;
    RestCheck rest;
    double chi2_per_dof = 0.0;
    std::int64_t dof = 0;
};

// bias   its law with temperature: while it warms, the halves of a tick differ.
// field  of each log; none: not known.
[[nodiscard]] DriftLaw find_drift_law(std::span<const LabLog> logs, double scale_arcsec, double rate_arcsec_s,
                                      const BiasLaw& bias, std::span<const FieldCourse> field = {});

}  // namespace zlg::calibration
