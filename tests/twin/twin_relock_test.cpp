// The twin's loop, and the false angle after re-lock.

#include "quiet_gyro.hpp"

namespace zlg::twin::twin_relock_test {

TEST(TwinRelock, WithTheWrongReferenceTheLoopPushesAway) {
    TwinConfig config = quiet_gyro();
    config.perimeter.miss_lambda = 0.0;
    config.piezo.dac_bits = 24;
    Twin right{config, Motion::rest()};
    Twin wrong{config, Motion::rest()};
    advance(right, frame(false, 1, 150.8), 20);
    advance(wrong, frame(false, 1, 150.8), 20);
    EXPECT_LT(advance(right, frame(true, 1), 2).back().truth.detuning_end_lambda, 0.006);
    EXPECT_GT(advance(wrong, frame(true, -1), 2).back().truth.detuning_end_lambda, 0.016);
}

TEST(TwinRelock, BetweenTheModesTheLoopHoldsWhatItHas) {
    TwinConfig config = quiet_gyro();
    config.perimeter.miss_lambda = 0.0;
    Twin twin{config, Motion::rest()};
    const double dark_v = advance(twin, frame(false, 1, 150.0 + 0.245 * 80.0), 40).back().truth.perimeter_v;
    const TwinHalf later = advance(twin, frame(true, 1), 100).back();
    EXPECT_FALSE(later.truth.lit);
    EXPECT_NEAR(later.truth.perimeter_v, dark_v, 1e-9);
}

// The mode lies 10 V beyond the range; a loop that had gone on integrating would need the same time to come back.
TEST(TwinRelock, AtTheEndOfTheRangeTheIntegratorDoesNotWindUp) {
    TwinConfig config = quiet_gyro();
    config.perimeter.miss_lambda = 0.0;
    Twin twin{config, Motion::rest()};
    advance(twin, frame(false, 1, 300.0), 60);
    EXPECT_NEAR(advance(twin, frame(true, 1), 400).back().truth.perimeter_v, 300.0, 1e-9);
    EXPECT_LT(advance(twin, frame(true, -1), 2).back().truth.perimeter_v, 297.0);
}

TEST(TwinRelock, UnderASteadyExpansionTheLoopLagsByItsTimeConstant) {
    TwinConfig config = quiet_gyro();
    config.perimeter.expansion_lambda_per_c = 0.025;
    config.drift.thermal_time_s = 100.0;
    Twin twin{config, Motion::rest()};
    const double lag = advance(twin, frame(true, 1), 800).back().truth.detuning_end_lambda;
    const double expected = config.perimeter.tau_s * 0.5 / 100.0 * std::exp(-2.0 / 100.0);
    EXPECT_NEAR(lag, expected, 1e-3 * expected);
}

// Continuous linear loop of 6.5 ms, limiter at 0.09, RC of 1 ms, miss of 0.22: values of an independent simulation.
TEST(TwinRelock, TheFalseDriftAfterRelockDecaysAsMeasured) {
    const std::vector<double> drift = false_drift_deg_h(relocked(quiet_gyro(), 190.0, 40), 0.005);
    EXPECT_NEAR(drift[0], 4130.0, 0.03 * 4130.0);
    EXPECT_NEAR(drift[1], 3168.0, 0.03 * 3168.0);
    EXPECT_NEAR(drift[2], 1296.0, 0.03 * 1296.0);
    EXPECT_NEAR(drift[3], 218.0, 10.0);
    double angle = 0.0;
    for (const double rate : drift) angle += rate * 0.005;
    EXPECT_NEAR(angle, 44.1, 0.5);
}

TEST(TwinRelock, WithoutTheHighVoltageLagTheFirstTickIsLargerAndTheThirdSmaller) {
    TwinConfig config = quiet_gyro();
    config.piezo.rc_s = 2e-6;
    config.piezo.slew_v_s = 1e6;
    const std::vector<double> drift = false_drift_deg_h(relocked(config, 190.0, 8), 0.005);
    EXPECT_NEAR(drift[0], 4523.0, 0.03 * 4523.0);
    EXPECT_NEAR(drift[1], 2832.0, 0.03 * 2832.0);
    EXPECT_NEAR(drift[2], 886.0, 0.03 * 886.0);
    EXPECT_NEAR(drift[3], 190.0, 10.0);
}

TEST(TwinRelock, ASmallMissGivesAFalseAngleThatGrowsWithItsSquare) {
    TwinConfig config = quiet_gyro();
    config.perimeter.miss_lambda = 0.01;
    const std::vector<double> small = false_drift_deg_h(relocked(config, 190.0, 8), 0.005);
    config.perimeter.miss_lambda = 0.03;
    const std::vector<double> large = false_drift_deg_h(relocked(config, 190.0, 8), 0.005);
    for (std::size_t tick = 0; tick < small.size(); ++tick) EXPECT_NEAR(large[tick] / small[tick], 9.0, 1e-6);
}

// dOm_i = chi f0 dl0^2 (tau/2T) q^(2(i-1)) (1 - q)^2, q = exp(-T/tau), for reversals that take no time.
TEST(TwinRelock, TheExponentialLoopGivesTheClosedForm) {
    TwinConfig config = quiet_gyro();
    config.perimeter.loop = Loop::exponential;
    config.perimeter.tau_s = 3.5 * 0.005;
    config.gyro.bias_edge_s = 0.0;
    config.perimeter.expansion_lambda_per_c = 0.025;
    const std::vector<double> drift = false_drift_deg_h(relocked(config, 190.0, 40), 0.005);
    const double q = std::exp(-1.0 / 3.5);
    for (std::size_t tick = 0; tick < drift.size(); ++tick) {
        const double expected_hz = 3.6 * 60e3 * 0.22 * 0.22 * (3.5 / 2.0) *
                                   std::pow(q, 2.0 * static_cast<double>(tick)) * (1.0 - q) * (1.0 - q);
        EXPECT_NEAR(drift[tick], config.gyro.scale_arcsec * expected_hz,
                    1e-7 * config.gyro.scale_arcsec * expected_hz + 1e-9);
    }
}

// Of dl^4 alone the square of q stands for q, and half of tau for tau; of dl^6 the cube and a third.
TEST(TwinRelock, HigherTermsOfTheLossGiveTheClosedForm) {
    for (const int power : {2, 3}) {
        TwinConfig config = quiet_gyro();
        config.perimeter.loop = Loop::exponential;
        config.perimeter.tau_s = 3.5 * 0.005;
        config.gyro.bias_edge_s = 0.0;
        config.gyro.bias_chi = 0.0;
        config.gyro.bias_chi_higher = std::vector<double>(static_cast<unsigned>(power - 1), 0.0);
        config.gyro.bias_chi_higher.back() = -30.0;
        config.perimeter.expansion_lambda_per_c = 0.025;
        const std::vector<double> drift = false_drift_deg_h(relocked(config, 190.0, 10), 0.005);
        const double q = std::exp(-power / 3.5);
        for (std::size_t tick = 0; tick < drift.size(); ++tick) {
            const double expected_hz = -30.0 * 60e3 * std::pow(0.22, 2 * power) * (3.5 / 2.0 / power) *
                                       std::pow(q, 2.0 * static_cast<double>(tick)) * (1.0 - q) * (1.0 - q);
            EXPECT_NEAR(drift[tick], config.gyro.scale_arcsec * expected_hz,
                        1e-3 * config.gyro.scale_arcsec * std::abs(expected_hz) + 1e-9);
        }
    }
}

// The same equations once more, in volts, by brute force: 0.5 us steps of the classical rule and Simpson's.
class BruteForce {
public:
    explicit BruteForce(const TwinConfig& config) : c_{config} {}

    // False angle of each half after a closing at -miss.
    [[nodiscard]] std::vector<double> false_arcsec(int n_halves, int first_sign) {
        dl_ = -c_.perimeter.miss_lambda;
        command_ = dl_;
        const double plateau_hz = c_.gyro.bias_hz / (1.0 - c_.gyro.bias_edge_s / c_.gyro.tick_s);
        std::vector<double> result;
        for (int h = 0; h < n_halves; ++h) {
            const double start_sq = dl_ * dl_;
            double integral = 0.0;
            const int n = 5000;
            const double dt = 0.5 * c_.gyro.tick_s / n;
            for (int k = 0; k < n; ++k) {
                const double a = dl_ * dl_;
                move(0.5 * dt);
                const double b = dl_ * dl_;
                move(0.5 * dt);
                integral += dt / 6.0 * (a + 4.0 * b + dl_ * dl_);
            }
            integral -= 0.25 * c_.gyro.bias_edge_s * (start_sq + dl_ * dl_);
            result.push_back(-(h % 2 == 0 ? first_sign : -first_sign) * c_.gyro.scale_arcsec * plateau_hz *
                             c_.gyro.bias_chi * integral);
        }
        return result;
    }

private:
    void move(double dt) {
        const double kp = 0.5 / c_.piezo.half_wave_v;
        const auto command_rate = [&](double dl) {
            return -std::min(std::max(dl, -c_.perimeter.limit_lambda), c_.perimeter.limit_lambda) / c_.perimeter.tau_s;
        };
        const auto dl_rate = [&](double command, double dl) {
            const double slew = kp * c_.piezo.slew_v_s;
            return std::min(std::max((command - dl) / c_.piezo.rc_s, -slew), slew);
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

TEST(TwinRelock, TheFalseAngleAgreesWithBruteForceToAMillionth) {
    for (const double slew_v_s : {4000.0, 800.0}) {
        TwinConfig config = quiet_gyro();
        config.piezo.slew_v_s = slew_v_s;
        const std::vector<TwinHalf> halves = relocked(config, 190.0, 16);
        // In mode -1 the bias of the first half, +1, counts with the opposite sign.
        const std::vector<double> expected = BruteForce{config}.false_arcsec(16, -1);
        for (std::size_t h = 0; h < halves.size(); ++h) {
            EXPECT_NEAR(halves[h].truth.false_relock_arcsec / expected[h], 1.0, 1e-6)
                << "half " << h << ", slew " << slew_v_s;
        }
    }
}

}  // namespace zlg::twin::twin_relock_test
