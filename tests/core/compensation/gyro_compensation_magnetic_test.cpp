#include "gyro_compensation_support.hpp"

namespace gyro_compensation_support::magnetic_test {

constexpr double tick_s = 0.05;
constexpr double scale_arcsec = 0.01;
constexpr double drift_arcsec_s = 0.7;

GyroCompensationConfig config_of(MagneticMethod method) {
    GyroCompensationConfig c;
    c.gyro.tick = Seconds{tick_s};
    c.gyro.scale = Arcsec{scale_arcsec};
    c.bridge.method = BridgeMethod::constant;
    c.gyro.random_walk = ArcsecPerRootSecond{0.01};
    c.magnetic.method = method;
    return c;
}

// A gyro at rest that switches every 30 s, the first time after 15 s: only the drift and the bias are counted.
Halves switching_gyro(double length_s) {
    Halves halves;
    double turned_arcsec = 0.0;
    std::int64_t before = 0;
    for (std::int64_t h = 0; static_cast<double>(h) * tick_s / 2.0 < length_s; ++h) {
        const double t_s = static_cast<double>(h / 2) * tick_s;
        const auto segment = static_cast<std::int64_t>((t_s + 15.0) / 30.0);
        const auto mode = static_cast<std::int8_t>(segment % 2 == 0 ? 1 : -1);
        const bool gap = segment > 0 && t_s + 15.0 < 30.0 * static_cast<double>(segment) + 3.0 * tick_s - 1e-9;
        turned_arcsec += mode * drift_arcsec_s * tick_s / 2.0;
        const auto now = static_cast<std::int64_t>(std::floor(turned_arcsec / scale_arcsec));
        const auto sign = static_cast<std::int8_t>(h % 2 == 0 ? 1 : -1);
        halves.push_back({.half = h, .counts = now - before + sign * mode * 1000, .bias_sign = sign, .mode = mode});
        halves.back().loop_closed = !gap;
        before = now;
    }
    return halves;
}

TEST(GyroCompensationMagnetic, TheSawtoothLeavesBothColumnsAlike) {
    const Halves halves = switching_gyro(1200.0);
    const Delivered got = run(config_of(MagneticMethod::estimate), halves);
    double delivered = 0.0, final_sum = 0.0, highest = 0.0;
    for (const auto& s : got.samples) {
        delivered += s.sample.dtheta_arcsec;
        if (s.sample.tick > 15000) highest = std::max(highest, std::abs(delivered));
    }
    for (const AngleRow& row : got.rows) final_sum += row.dtheta_final_arcsec;
    EXPECT_NEAR(delivered, final_sum, 1e-9);
    EXPECT_NEAR(got.samples.back().angle_arcsec, delivered, 1e-9);
    // 10.5 arcsec without.
    EXPECT_LT(highest, 1.0);
}

TEST(GyroCompensationMagnetic, WithoutItAndWhileWatchingTheAngleIsThatOfTheCounts) {
    const Halves halves = switching_gyro(600.0);
    const Delivered none = run(config_of(MagneticMethod::none), halves);
    const Delivered watching = run(config_of(MagneticMethod::watch), halves);
    ASSERT_EQ(none.rows.size(), watching.rows.size());
    for (std::size_t k = 0; k < none.rows.size(); ++k) ASSERT_EQ(none.rows[k], watching.rows[k]);
}

TEST(GyroCompensationMagnetic, AdviceIsWhatWasMeasured) {
    const Halves halves = switching_gyro(900.0);
    for (const MagneticMethod method : {MagneticMethod::none, MagneticMethod::watch, MagneticMethod::estimate}) {
        const GyroCompensationConfig config = config_of(method);
        GyroCompensationState state;
        Delivered got;
        EXPECT_EQ(advice(config, state), SwitchAdvice{});
        for (const HalfRecord& half : halves) step_into(config, state, half, got);
        ASSERT_FALSE(got.gaps.empty());
        // All gaps of this gyro are alike.
        EXPECT_NEAR(advice(config, state).switch_error_arcsec, got.gaps.back().sigma_sum_arcsec, 1e-12);
        const double left = advice(config, state).magnetic_arcsec_s;
        if (method == MagneticMethod::none) EXPECT_EQ(left, 0.0);
        if (method == MagneticMethod::none) EXPECT_EQ(state.magnetic, MagneticDriftState{});  // of whole counts
        if (method == MagneticMethod::watch) EXPECT_NEAR(left, drift_arcsec_s, 0.01);
        if (method == MagneticMethod::estimate) EXPECT_LT(left, 0.1);
    }
}

TEST(GyroCompensationMagnetic, ARefusedEstimatorIsAFault) {
    GyroCompensationConfig config = config_of(MagneticMethod::estimate);
    EXPECT_EQ(check(config), GyroCompensationFault::none);
    config.magnetic.thermal_time = Seconds{-1.0};
    EXPECT_EQ(check(config), GyroCompensationFault::magnetic);
}

}  // namespace gyro_compensation_support::magnetic_test
