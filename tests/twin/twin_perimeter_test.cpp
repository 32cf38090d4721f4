// The twin's perimeter: the piezo's move, the light between modes, the loop and the false angle after re-lock.

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "quiet_gyro.hpp"

namespace zlg::twin {
namespace {

TEST(TwinPerimeter, AMoveOfOneHalfWaveIsSlewLimitedAndTakesTenMilliseconds) {
    TwinConfig config = held_gyro();
    config.high_voltage_rc_s = 1e-6;
    Twin twin{config, Motion::rest()};
    const std::vector<TwinHalf> halves = advance(twin, frame(false, -1, 190.0), 5);
    for (std::size_t h = 0; h < 4; ++h) {
        EXPECT_NEAR(halves[h].truth.perimeter_v, 150.0 + 10.0 * static_cast<double>(h + 1), 0.005);
    }
    EXPECT_NEAR(halves[4].truth.perimeter_v, 190.0, 1e-4);
}

TEST(TwinPerimeter, TheLagTakesOverWhereItsCurrentFallsBelowTheLimit) {
    Twin twin{held_gyro(), Motion::rest()};
    const std::vector<TwinHalf> halves = advance(twin, frame(false, -1, 190.0), 6);
    // 4 V/ms until 4 V are missing, at 9 ms; then exponential with 1 ms.
    EXPECT_NEAR(halves[2].truth.perimeter_v, 180.0, 1e-4);
    EXPECT_NEAR(halves[3].truth.perimeter_v, 190.0 - 4.0 * std::exp(-1.0), 1e-4);
    EXPECT_NEAR(halves[5].truth.perimeter_v, 190.0 - 4.0 * std::exp(-6.0), 1e-4);
}

TEST(TwinPerimeter, SetPointsHaveTheStepsAndTheRangeOfTheirConverter) {
    TwinConfig config = held_gyro();
    config.dac_bits = 8;
    Twin twin{config, Motion::rest()};
    const double step_v = 300.0 / 256.0;
    const double settled_v = advance(twin, frame(false, 1, 100.3), 60).back().truth.perimeter_v;
    EXPECT_NEAR(settled_v, std::round(100.3 / step_v) * step_v, 1e-9);
    EXPECT_NEAR(advance(twin, frame(false, 1, 5000.0), 100).back().truth.perimeter_v, 300.0, 1e-9);
    EXPECT_NEAR(advance(twin, frame(false, 1, -5000.0), 100).back().truth.perimeter_v, 0.0, 1e-9);
}

TEST(TwinPerimeter, SetPointsFollowOneAnotherEquallySpaced) {
    TwinConfig config = held_gyro();
    config.high_voltage_rc_s = 1e-6;
    config.slew_v_s = 1e9;
    config.light_samples = 6;
    Twin twin{config, Motion::rest()};
    core::ActuatorFrame actuator = frame(true, 1);
    actuator.n_set_points = 3;
    actuator.set_point_v = {154.0, 146.0, 158.0};
    const core::SensorFrame sensor = twin.advance(actuator).sensor;
    const std::array<double, 6> detuning = {0.05, 0.05, -0.05, -0.05, 0.1, 0.1};
    for (std::size_t k = 0; k < 6; ++k) {
        const double a = static_cast<double>(sensor.light_a[k]);
        const double b = static_cast<double>(sensor.light_b[k]);
        EXPECT_NEAR((a - b) / (a + b), 0.332 * detuning[k], 2e-6) << "sample " << k;
    }
}

TEST(TwinPerimeter, LightTellsTheDetuningWithTheSignOfBiasAndHelicity) {
    Twin twin{held_gyro(), Motion::rest()};
    const auto expect_ratio = [&](const core::ActuatorFrame& actuator, double expected) {
        for (const TwinHalf& half : advance(twin, actuator, 2)) {
            const double a = static_cast<double>(half.sensor.light_a[0]);
            const double b = static_cast<double>(half.sensor.light_b[0]);
            EXPECT_NEAR(half.sensor.bias_sign * (a - b) / (a + b), expected, 1e-6);
            EXPECT_TRUE(half.truth.lit);
        }
    };
    advance(twin, frame(true, 1, 158.0), 20);
    expect_ratio(frame(true, 1, 158.0), 0.332 * 0.1);
    advance(twin, frame(true, 1, 198.0), 20);
    expect_ratio(frame(true, 1, 198.0), -0.332 * 0.1);
}

TEST(TwinPerimeter, LightIsOneWayBetweenTheModesAndTwoWayAgainInTheNext) {
    Twin twin{held_gyro(), Motion::rest()};
    const std::vector<TwinHalf> halves = advance(twin, frame(false, -1, 190.0), 6);
    int dark = 0;
    for (const TwinHalf& half : halves) {
        for (std::size_t k = 0; k < 16; ++k) {
            const float least = std::min(half.sensor.light_a[k], half.sensor.light_b[k]);
            if (least == 0.0f) {
                ++dark;
                EXPECT_FALSE(half.truth.lit);
                EXPECT_GT(std::max(half.sensor.light_a[k], half.sensor.light_b[k]), 900.0f);
            }
        }
    }
    // 0.02 wavelength at 0.05 per ms is 0.4 ms of samples 0.156 ms apart.
    EXPECT_GE(dark, 2);
    EXPECT_LE(dark, 3);
    EXPECT_TRUE(halves[0].truth.lit);
    EXPECT_TRUE(halves[5].truth.lit);
    EXPECT_NEAR(halves[5].truth.detuning_end_lambda, 0.0, 1e-3);
}

TEST(TwinPerimeter, WithoutTwoWayLightTheCounterShowsGarbageWithinTheBias) {
    TwinConfig config = held_gyro();
    config.bias_hz = 1e9;
    Twin twin{config, Motion::rest()};
    TwinHalf before = advance(twin, frame(true, 1, 170.0), 40).back();
    double largest = 0.0;
    for (int h = 0; h < 100; ++h) {
        const TwinHalf after = twin.advance(frame(true, 1, 170.0));
        EXPECT_FALSE(after.truth.lit);
        EXPECT_EQ(after.truth.false_relock_arcsec, 0.0);
        largest = std::max(largest, std::abs(static_cast<double>(count_between(before, after))));
        before = after;
    }
    // The mean of 16 uniform numbers in +-1 has sigma 0.144; the largest of 100 is near 2.5 sigma.
    EXPECT_GT(largest, 0.2 * 2.5e6);
    EXPECT_LT(largest, 0.8 * 2.5e6);
}

TEST(TwinPerimeter, AHeldDetuningLowersTheMeanBiasByChiTimesItsSquare) {
    TwinConfig config = held_gyro();
    config.bias_hz = 1e12;
    Twin twin{config, Motion::rest()};
    const TwinHalf before = advance(twin, frame(true, 1, 158.0), 41).back();
    const TwinHalf after = twin.advance(frame(true, 1, 158.0));
    EXPECT_EQ(after.sensor.bias_sign, -1);
    const double lost = 3.6 * 0.01;
    EXPECT_NEAR(static_cast<double>(count_between(before, after)), -2.5e9 * (1.0 - lost), 2e3);
    EXPECT_NEAR(after.truth.false_relock_arcsec, 2.5e9 * lost * config.scale_arcsec, 1e-5 * 2.5e9 * lost);
}

TEST(TwinPerimeter, WithTheWrongReferenceTheLoopPushesAway) {
    TwinConfig config = quiet_gyro();
    config.miss_lambda = 0.0;
    config.dac_bits = 24;
    Twin right{config, Motion::rest()};
    Twin wrong{config, Motion::rest()};
    advance(right, frame(false, 1, 150.8), 20);
    advance(wrong, frame(false, 1, 150.8), 20);
    EXPECT_LT(advance(right, frame(true, 1), 2).back().truth.detuning_end_lambda, 0.006);
    EXPECT_GT(advance(wrong, frame(true, -1), 2).back().truth.detuning_end_lambda, 0.016);
}

// A loop without strength keeps what it is given, so the end of the half shows the detuning at its start.
TEST(TwinPerimeter, EveryClosingHasTheMissAskedForShortOfTheTarget) {
    for (const LoopKind loop : {LoopKind::analog, LoopKind::exponential, LoopKind::external}) {
        TwinConfig config = quiet_gyro();
        config.loop = loop;
        config.loop_tau_s = 1e9;
        config.miss_lambda = 0.17;
        config.expansion_lambda_per_c = 0.01;
        config.thermal_time_s = 1e4;
        Twin twin{config, Motion::rest()};
        int polarity = 1;
        double from_v = 150.0;
        for (const double target_v : {190.0, 150.0, 110.0, 150.0, 190.0, 230.0, 270.0, 290.0, 250.0}) {
            polarity = -polarity;
            advance(twin, frame(false, polarity, target_v), 7);
            const TwinHalf half = advance(twin, frame(true, polarity, target_v), 1).back();
            const double expected = target_v > from_v ? -0.17 : 0.17;
            EXPECT_NEAR(half.truth.detuning_end_lambda, expected, 2e-5) << "to " << target_v << " V";
            const double parity = std::remainder((half.truth.perimeter_v - 150.0) / 80.0 - expected, 1.0);
            EXPECT_NEAR(std::abs(parity), polarity > 0 ? 0.0 : 0.5, 0.01) << "to " << target_v << " V";
            from_v = target_v;
        }
    }
}

TEST(TwinPerimeter, TheInjectedErrorOfAnExternalLoopStaysUntilTheNextOpening) {
    TwinConfig config = held_gyro();
    config.miss_lambda = 0.2;
    Twin twin{config, Motion::rest()};
    advance(twin, frame(false, -1, 190.0), 6);
    advance(twin, frame(true, -1, 190.0), 10);
    EXPECT_NEAR(advance(twin, frame(true, -1, 190.0), 100).back().truth.detuning_end_lambda, -0.2, 1e-3);
    // The processor's own correction acts beside it.
    EXPECT_NEAR(advance(twin, frame(true, -1, 206.0), 100).back().truth.detuning_end_lambda, 0.0, 1e-3);
}

TEST(TwinPerimeter, WithoutAnInjectedMissTheLoopClosesWhereTheVoltageIs) {
    TwinConfig config = quiet_gyro();
    config.miss_lambda = 0.0;
    config.loop_tau_s = 1e9;
    config.dac_bits = 24;
    const TwinHalf half = relocked(config, 186.0, 1).back();
    const double settled_v = 186.0 - 4.0 * std::exp(-(15.0 - 8.0));
    EXPECT_NEAR(half.truth.detuning_end_lambda, (settled_v - 190.0) / 80.0, 1e-6);
}

// Continuous linear loop of 6.5 ms, limiter at 0.09, RC of 1 ms, miss of 0.22: values of an independent simulation.
TEST(TwinPerimeter, TheFalseDriftAfterRelockDecaysAsMeasured) {
    const std::vector<double> drift = false_drift_deg_h(relocked(quiet_gyro(), 190.0, 40), 0.005);
    EXPECT_NEAR(drift[0], 4130.0, 0.03 * 4130.0);
    EXPECT_NEAR(drift[1], 3168.0, 0.03 * 3168.0);
    EXPECT_NEAR(drift[2], 1296.0, 0.03 * 1296.0);
    EXPECT_NEAR(drift[3], 218.0, 10.0);
    double angle = 0.0;
    for (const double rate : drift) angle += rate * 0.005;
    EXPECT_NEAR(angle, 44.1, 0.5);
}

TEST(TwinPerimeter, WithoutTheHighVoltageLagTheFirstTickIsLargerAndTheThirdSmaller) {
    TwinConfig config = quiet_gyro();
    config.high_voltage_rc_s = 2e-6;
    config.slew_v_s = 1e6;
    const std::vector<double> drift = false_drift_deg_h(relocked(config, 190.0, 8), 0.005);
    EXPECT_NEAR(drift[0], 4523.0, 0.03 * 4523.0);
    EXPECT_NEAR(drift[1], 2832.0, 0.03 * 2832.0);
    EXPECT_NEAR(drift[2], 886.0, 0.03 * 886.0);
    EXPECT_NEAR(drift[3], 190.0, 10.0);
}

TEST(TwinPerimeter, ASmallMissGivesAFalseAngleThatGrowsWithItsSquare) {
    TwinConfig config = quiet_gyro();
    config.miss_lambda = 0.01;
    const std::vector<double> small = false_drift_deg_h(relocked(config, 190.0, 8), 0.005);
    config.miss_lambda = 0.03;
    const std::vector<double> large = false_drift_deg_h(relocked(config, 190.0, 8), 0.005);
    for (std::size_t tick = 0; tick < small.size(); ++tick) EXPECT_NEAR(large[tick] / small[tick], 9.0, 1e-6);
}

// dOm_i = chi f0 dl0^2 (tau/2T) q^(2(i-1)) (1 - q)^2, q = exp(-T/tau), for reversals that take no time.
TEST(TwinPerimeter, TheExponentialLoopGivesTheClosedForm) {
    TwinConfig config = quiet_gyro();
    config.loop = LoopKind::exponential;
    config.loop_tau_s = 3.5 * 0.005;
    config.bias_edge_s = 0.0;
    config.expansion_lambda_per_c = 0.025;
    const std::vector<double> drift = false_drift_deg_h(relocked(config, 190.0, 40), 0.005);
    const double q = std::exp(-1.0 / 3.5);
    for (std::size_t tick = 0; tick < drift.size(); ++tick) {
        const double expected_hz = 3.6 * 60e3 * 0.22 * 0.22 * (3.5 / 2.0) *
                                   std::pow(q, 2.0 * static_cast<double>(tick)) * (1.0 - q) * (1.0 - q);
        EXPECT_NEAR(drift[tick], config.scale_arcsec * expected_hz, 1e-7 * config.scale_arcsec * expected_hz + 1e-9);
    }
}

// The same equations once more, in volts, by brute force: 0.5 us steps of the classical rule and Simpson's.
class BruteForce {
public:
    explicit BruteForce(const TwinConfig& config) : c_{config} {}

    // False angle of each half after a closing at -miss.
    [[nodiscard]] std::vector<double> false_arcsec(int n_halves, int first_sign) {
        dl_ = -c_.miss_lambda;
        command_ = dl_;
        const double plateau_hz = c_.bias_hz / (1.0 - c_.bias_edge_s / c_.tick_s);
        std::vector<double> result;
        for (int h = 0; h < n_halves; ++h) {
            const double start_sq = dl_ * dl_;
            double integral = 0.0;
            const int n = 5000;
            const double dt = 0.5 * c_.tick_s / n;
            for (int k = 0; k < n; ++k) {
                const double a = dl_ * dl_;
                move(0.5 * dt);
                const double b = dl_ * dl_;
                move(0.5 * dt);
                integral += dt / 6.0 * (a + 4.0 * b + dl_ * dl_);
            }
            integral -= 0.25 * c_.bias_edge_s * (start_sq + dl_ * dl_);
            result.push_back(-(h % 2 == 0 ? first_sign : -first_sign) * c_.scale_arcsec * plateau_hz * c_.bias_chi *
                             integral);
        }
        return result;
    }

private:
    void move(double dt) {
        const double kp = 0.5 / c_.half_wave_v;
        const auto command_rate = [&](double dl) {
            return -std::min(std::max(dl, -c_.loop_limit_lambda), c_.loop_limit_lambda) / c_.loop_tau_s;
        };
        const auto dl_rate = [&](double command, double dl) {
            const double slew = kp * c_.slew_v_s;
            return std::min(std::max((command - dl) / c_.high_voltage_rc_s, -slew), slew);
        };
        const double c1 = command_rate(dl_);
        const double d1 = dl_rate(command_, dl_);
        const double c2 = command_rate(dl_ + 0.5 * dt * d1);
        const double d2 = dl_rate(command_ + 0.5 * dt * c1, dl_ + 0.5 * dt * d1);
        const double c3 = command_rate(dl_ + 0.5 * dt * d2);
        const double d3 = dl_rate(command_ + 0.5 * dt * c2, dl_ + 0.5 * dt * d2);
        const double c4 = command_rate(dl_ + dt * d3);
        const double d4 = dl_rate(command_ + dt * c3, dl_ + dt * d3);
        command_ += dt / 6.0 * (c1 + 2.0 * c2 + 2.0 * c3 + c4);
        dl_ += dt / 6.0 * (d1 + 2.0 * d2 + 2.0 * d3 + d4);
    }

    TwinConfig c_;
    double dl_ = 0.0;
    double command_ = 0.0;
};

TEST(TwinPerimeter, TheFalseAngleAgreesWithBruteForceToAMillionth) {
    for (const double slew_v_s : {4000.0, 800.0}) {
        TwinConfig config = quiet_gyro();
        config.slew_v_s = slew_v_s;
        const std::vector<TwinHalf> halves = relocked(config, 190.0, 16);
        // In mode -1 the bias of the first half, +1, counts with the opposite sign.
        const std::vector<double> expected = BruteForce{config}.false_arcsec(16, -1);
        for (std::size_t h = 0; h < halves.size(); ++h) {
            EXPECT_NEAR(halves[h].truth.false_relock_arcsec / expected[h], 1.0, 1e-6)
                << "half " << h << ", slew " << slew_v_s;
        }
    }
}

}  // namespace
}  // namespace zlg::twin
