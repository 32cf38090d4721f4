#include <zlg/core/compensation/magnetic_filter.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace magnetic_filter_test {

using namespace zlg::core;

MagneticFilterState drifting(double drift_arcsec_s, double trend_arcsec_s2) {
    MagneticFilterState state;
    state.estimate[of_drift] = drift_arcsec_s;
    state.estimate[of_trend] = trend_arcsec_s2;
    return state;
}

TEST(MagneticFilter, APredictionIsTheSolutionOfItsEquations) {
    constexpr double tau_s = 3000.0, time_s = 900.0, drift = 0.7, trend = 1e-3;
    const double fading = 1.0 - std::exp(-time_s / tau_s);
    for (const int mode : {1, -1}) {
        MagneticFilterState state = drifting(drift, trend);
        predict(state, static_cast<std::int8_t>(mode), time_s, tau_s);
        EXPECT_NEAR(state.estimate[of_drift], drift + trend * tau_s * fading, 1e-12);
        EXPECT_NEAR(state.estimate[of_trend], trend * (1.0 - fading), 1e-15);
        EXPECT_NEAR(state.estimate[of_angle], mode * (drift * time_s + trend * tau_s * (time_s - tau_s * fading)),
                    1e-9);
    }
}

TEST(MagneticFilter, InAGapTheAngleStays) {
    MagneticFilterState state = drifting(0.7, 0.0);
    predict(state, 0, 10.0, 3000.0);
    EXPECT_EQ(state.estimate[of_angle], 0.0);
}

TEST(MagneticFilter, TheFirstSegmentShowsTheBaseAndTheNextOnesTheDrift) {
    constexpr double base = 15.0, drift = 0.7, segment_s = 90.0;
    MagneticFilterState state;
    state.covariance[of_drift][of_drift] = 100.0;
    int mode = 1;
    for (int k = 0; k < 40; ++k, mode = -mode) {
        predict(state, static_cast<std::int8_t>(mode), segment_s, 3000.0);
        update(state, {.mode = static_cast<double>(mode),
                       .length_s = segment_s,
                       .rate = {.mean_arcsec_s = base + mode * drift},
                       .variance = 1e-6});
        EXPECT_TRUE(state.base_known);
        if (k == 0) EXPECT_EQ(state.estimate[of_drift], 0.0);
    }
    EXPECT_NEAR(state.estimate[of_drift], drift, 0.03);
    EXPECT_NEAR(state.estimate[of_base], base, 0.05);
}

}  // namespace magnetic_filter_test
