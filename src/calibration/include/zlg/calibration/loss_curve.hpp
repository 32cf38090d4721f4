#pragma once
// The inverse discriminator F, from the loss of bias in the halves after re-locks.
//
//   f = f0 (1 - chi F(x)^2),  x the logged detuning, F(x) -> x for small x
//
//   chi F^2 = G(x) = x^2 sum c_k (1 + x^2/x0^2)^-k,  k = 0..3;   chi = sum c_k
//
// A discriminator that grows faster than the detuning makes F bend down. G is found by least squares at the borders of
// the halves, x0 by the least sum of squares. Within a half x counts as two equal groups one standard deviation off
// its mean, as in the compensation. The counts determine G and not F: the scale of F for small x is that of the log.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <zlg/calibration/bias_law.hpp>
#include <zlg/calibration/lab_log.hpp>
#include <zlg/core/common/discriminator_curve.hpp>

namespace zlg::calibration {

struct LossCurve {
    bool determined = false;
    std::string reason;  // why not

    // Points from near 0 up to the detunings that a fifth of the re-locks exceed; one standard deviation of F, with chi
    // as it is: what the error of G makes of it.
    std::vector<double> logged_lambda;
    std::vector<double> detuning_lambda;
    std::vector<double> sigma_lambda;

    std::int64_t n_relocks = 0;
    double chi2_per_dof = 0.0;  // residuals over white rounding
    core::DiscriminatorCurve curve{};
};

// law  of the same logs, determined.
// return  not determined where the logs do not distinguish F from the linear law: from a third of the last point to
// that
//         point G/x^2 must change by 5 % and by 6 of its standard deviations; nor where the counter of a gyro at rest
//         rounds alike after every re-lock.
[[nodiscard]] LossCurve find_loss_curve(std::span<const LabLog> logs, const BiasLaw& law);

// The logs as F reads them: mean detunings and mean squares after re-locks, light noise as it was.
[[nodiscard]] std::vector<LabLog> straightened(std::span<const LabLog> logs, const LossCurve& found);

}  // namespace zlg::calibration
