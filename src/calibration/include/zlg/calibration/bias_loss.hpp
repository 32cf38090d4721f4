#pragma once
// chi, the loss of bias with detuning, from the halves after re-locks.
//
//   f = f0 (1 - chi dl^2),  dl^2: the logged mean square less that of the settled gyro, which is light noise
//
// chi is in units of the logged detuning, as the compensation uses it: the scale of the detuning signal is contained
// in it (twice the logged detuning, a quarter of chi).
//
// The counts since the first border after a gap are compared with those of a bias without loss. Each border has one
// rounding of its own, but the counter of a settled gyro repeats the same two readings: borders after the transient
// make one observation for each of the two. Light noise makes the abscissa uncertain, which would pull chi towards 0;
// what it adds to the sums of squares is known from the settled scatter and subtracted.

#include <cstdint>
#include <span>

#include <zlg/calibration/bias_law.hpp>
#include <zlg/calibration/lab_log.hpp>
#include <zlg/numeric/estimate.hpp>

namespace zlg::calibration {

struct BiasLoss {
    numeric::Estimate chi;
    std::int64_t n_relocks = 0;
    double chi2_per_dof = 0.0;    // residuals over white rounding, 1/12 count^2 a border, and light noise
    double deficit_counts = 0.0;  // mean size of the loss, counts of the first half
};

// law  of the same logs, determined.
[[nodiscard]] BiasLoss find_bias_loss(std::span<const LabLog> logs, const BiasLaw& law);

}  // namespace zlg::calibration
