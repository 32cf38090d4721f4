#include <zlg/calibration/lock_in_law.hpp>

#include "synthetic_gyro.hpp"

namespace zlg::calibration::lock_in_law_test {

using synthetic::SyntheticGyro;

// K f0 of the synthetic gyro.
constexpr double cancelling_arcsec_s = 3.263 * 60'123.4;

const std::vector<double> to_near_the_bias{0.0, 0.3, -0.5, 0.8, -0.85, 0.9, -0.92, 0.94, -0.95, 0.96, -0.965};

// Of a gyro whose scale is not what is presumed.
LockInLaw law_of(SyntheticGyro gyro, const std::vector<double>& parts, double duration_s) {
    std::vector<LabLog> logs;
    std::vector<double> rates;
    for (const double part : parts) {
        gyro.rate_arcsec_s = part * cancelling_arcsec_s;
        ++gyro.seed;
        logs.push_back(synthetic::log_of(gyro, duration_s, [](auto&) {}));
        rates.push_back(1.0003 * gyro.rate_arcsec_s + 4.0);
    }
    return find_lock_in_law(logs, rates, {.edge_s = 0.0});
}

TEST(LockInLaw, TheThresholdIsFoundWithinItsSigma) {
    double square = 0.0;
    constexpr int n = 8;
    for (int k = 0; k < n; ++k) {
        const LockInLaw law = law_of({.magnetic_arcsec_s = 0.7,
                                      .walk_arcsec_sqrt_s = 0.1,
                                      .seed = static_cast<std::uint64_t>(100 * k),
                                      .lock_hz = 240.0},
                                     to_near_the_bias, 20.0);
        ASSERT_TRUE(law.threshold_hz.determined) << law.threshold_hz.reason;
        EXPECT_LT(law.threshold_hz.sigma, 0.02 * 240.0);
        const double off = (law.threshold_hz.value - 240.0) / law.threshold_hz.sigma;
        square += off * off / n;
    }
    EXPECT_LT(square, 2.0);
}

TEST(LockInLaw, WithoutLockInNoneIsFound) {
    const LockInLaw law = law_of({.walk_arcsec_sqrt_s = 0.1}, to_near_the_bias, 20.0);
    EXPECT_FALSE(law.threshold_hz.determined) << law.threshold_hz.value << " " << law.threshold_hz.sigma;
    EXPECT_NE(law.threshold_hz.reason.find("+-"), std::string::npos) << law.threshold_hz.reason;
}

TEST(LockInLaw, RatesFarFromTheBiasDoNotTellIt) {
    const LockInLaw law =
        law_of({.walk_arcsec_sqrt_s = 0.1, .lock_hz = 240.0}, {0.0, 0.1, -0.1, 0.2, -0.2, 0.3, -0.3}, 20.0);
    EXPECT_FALSE(law.threshold_hz.determined) << law.threshold_hz.value << " " << law.threshold_hz.sigma;
}

TEST(LockInLaw, FewRatesAreRefusedInOneLine) {
    for (const std::vector<double>& parts :
         {std::vector<double>{0.0}, std::vector<double>{0.1, 0.1, 0.1}, std::vector<double>{0.0, 0.5, 0.9, 0.96}}) {
        const LockInLaw law = law_of({.lock_hz = 240.0}, parts, 10.0);
        EXPECT_FALSE(law.threshold_hz.determined);
        EXPECT_NE(law.threshold_hz.reason.find("5 or more"), std::string::npos) << law.threshold_hz.reason;
        EXPECT_EQ(law.threshold_hz.reason.find('\n'), std::string::npos);
    }
}

}  // namespace zlg::calibration::lock_in_law_test
