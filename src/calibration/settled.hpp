#pragma once
// What light noise does to the mean square of a half, seen on the settled gyro.

#include <cmath>

#include <zlg/calibration/lab_log.hpp>

namespace zlg::calibration {

struct LightNoise {
    double square_lambda2 = 0.0;    // mean square of the settled gyro: the variance of one sample
    double variance_lambda4 = 0.0;  // scatter of that mean square from half to half

    explicit LightNoise(const Moments& settled) : square_lambda2{settled.mean}, variance_lambda4{settled.variance()} {}

    // Variance of a mean square that is `excess` above the settled one: with n samples 2 s^4/n + 4 dl^2 s^2/n.
    [[nodiscard]] double variance_of(double excess_lambda2) const {
        if (!(square_lambda2 > 0.0)) return 0.0;
        return variance_lambda4 * (1.0 + 2.0 * std::fmax(excess_lambda2, 0.0) / square_lambda2);
    }
};

}  // namespace zlg::calibration
