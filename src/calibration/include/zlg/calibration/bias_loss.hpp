#pragma once
// chi, the loss of bias with detuning, from the halves after re-locks.
//
//   f = f0 (1 - chi dl^2 - h_0 dl^4 - h_1 dl^6 - h_2 dl^8)
//
// dl^2 is the logged mean square less that of the settled gyro, which is light noise; within a half the higher powers
// count two equal groups of samples one standard deviation off the mean. There are as many as lessen the residuals.
// Either sign and 0 are results.
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
#include <vector>

#include <zlg/calibration/bias_law.hpp>
#include <zlg/calibration/lab_log.hpp>
#include <zlg/numeric/estimate.hpp>

namespace zlg::calibration {

struct BiasLoss {
    numeric::Estimate chi;
    std::vector<double> higher;  // h_k, as far as they are told from 0
    std::int64_t n_relocks = 0;
    double chi2_per_dof = 0.0;    // residuals over white rounding, 1/12 count^2 a border, and light noise
    double deficit_counts = 0.0;  // mean size of the loss, counts of the first half
};

// law         of the same logs, determined.
// max_powers  1..4, chi among them: 1 for logs that a curve has made straight.
[[nodiscard]] BiasLoss find_bias_loss(std::span<const LabLog> logs, const BiasLaw& law, int max_powers = 4);

}  // namespace zlg::calibration
