#pragma once
// Threshold of lock-in, from logs of a rate table: by how much the scale grows towards the rate that cancels the bias.
//
//   c_j + L^2 h_j = a r_j T + d + m mode_j        j: the settled ticks of one log in one mode
//
// with c_j the mean counts of a tick, r_j the known rate, a the scale factor, d and m the drifts, and L^2 h_j what
// lock-in takes from both halves (core: lost_to_lock_in), which follows from the counts of the halves alone. Least
// squares in a, d, m and L^2, anew with the L found until it stands. Its standard error is the larger one of two: by
// the residuals, and by leaving out one log at a time (jackknife), for the dynamic zones near the bias make the
// residuals unequal. Where both modes tell L, half of their difference is added.

#include <cstdint>
#include <span>

#include <zlg/calibration/lab_log.hpp>
#include <zlg/numeric/estimate.hpp>

namespace zlg::calibration {

struct LockInLaw {
    numeric::Estimate threshold_hz;  // of the beat
    double scatter_ppm = 0.0;        // rms of the residuals, of the largest rate
    std::int64_t dof = 0;
};

struct LockInGyro {
    double edge_s = 50e-6;         // duration of a reversal of the bias
    double counts_per_turn = 1.0;  // of the beat
};

// rates_arcsec_s  known, one for each log.
[[nodiscard]] LockInLaw find_lock_in_law(std::span<const LabLog> logs, std::span<const double> rates_arcsec_s,
                                         const LockInGyro& gyro);

}  // namespace zlg::calibration
