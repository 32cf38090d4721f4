// The variance that the re-lock correction states, against trials with noise.
#include <zlg/core/compensation/relock_drift.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "compensation/compensation_support.hpp"
#include "relock_drift_support.hpp"

namespace relock_drift_noise_test {

using namespace zlg::core;
using namespace compensation_test;
using namespace relock_drift_support;

constexpr int n_trials = 20'000;  // the scatter of a variance is then 1 %
constexpr double tolerance = 0.05;

// Mean and mean square of noisy samples of dl0 exp(-t/tau) over half `half` of the decay, as the electronics make them.
void sample_half(Random& random, const Configured& c, double dl0, double half, double& mean, double& square) {
    mean = square = 0.0;
    for (int k = 0; k < c.gyro.light_samples; ++k) {
        const double t_ticks = 0.5 * (half + (k + 0.5) / c.gyro.light_samples);
        const double sample = dl0 * std::exp(-t_ticks / 3.5) + c.gyro.light_noise.value() * random.normal();
        mean += sample / c.gyro.light_samples;
        square += sample * sample / c.gyro.light_samples;
    }
}

// Ratio of the variance found to the mean variance stated.
double ratio_with_light_noise(RelockMethod method, double dl0, int light_samples) {
    Random random{static_cast<std::uint64_t>(light_samples) + 7};
    Configured config = configured(method);
    config.gyro.light_samples = light_samples;
    Statistics angle;
    Statistics stated;
    for (int trial = 0; trial < n_trials; ++trial) {
        RelockTick tick;
        sample_half(random, config, dl0, 0.0, tick.detuning_first_lambda, tick.detuning_sq_first_lambda2);
        sample_half(random, config, dl0, 1.0, tick.detuning_second_lambda, tick.detuning_sq_second_lambda2);
        RelockDriftState state{.armed = true};
        const FalseAngle out = step(config, state, tick).tick;
        EXPECT_TRUE(out.known);
        angle.add(out.value_arcsec);
        stated.add(out.variance_arcsec2);
    }
    return angle.variance() / stated.mean();
}

TEST(RelockDriftNoise, MeanSquareStatesItsVariance) {
    for (const double dl0 : {0.22, -0.1, 0.02, 0.01})
        for (const int light_samples : {1, 16, 25})
            EXPECT_NEAR(ratio_with_light_noise(RelockMethod::mean_square, dl0, light_samples), 1.0, tolerance)
                << dl0 << ' ' << light_samples;
}

TEST(RelockDriftNoise, DetuningStatesItsVariance) {
    for (const double dl0 : {0.22, -0.1, 0.05})
        for (const int light_samples : {16, 64})
            EXPECT_NEAR(ratio_with_light_noise(RelockMethod::detuning, dl0, light_samples), 1.0, tolerance)
                << dl0 << ' ' << light_samples;
}

DiscriminatorCurve straight(double slope) {
    DiscriminatorCurve curve{.n_nodes = 3};
    for (unsigned k = 0; k < 3; ++k) {
        curve.apparent_lambda[k] = 0.5 * (k - 1.0);
        curve.detuning_lambda[k] = slope * curve.apparent_lambda[k];
        curve.slope[k] = slope;
    }
    return curve;
}

double mean_square_variance(double noise_lambda, double own_slope, double control_slope) {
    Configured config = configured(RelockMethod::mean_square);
    config.gyro.light_noise = Wavelengths{noise_lambda};
    if (own_slope > 0.0) config.gyro.record_curve = straight(own_slope);
    if (control_slope > 0.0) config.gyro.control_curve = straight(control_slope);
    EXPECT_EQ(check(config.gyro), CompensationConstantsFault::none);
    RelockDriftState state{.armed = true};
    const RelockTick tick{.detuning_first_lambda = 0.1,
                          .detuning_second_lambda = 0.08,
                          .detuning_sq_first_lambda2 = 0.0102,
                          .detuning_sq_second_lambda2 = 0.0065};
    const FalseAngle found = step(config, state, tick).tick;
    EXPECT_TRUE(found.known);
    return found.variance_arcsec2;
}

// Light that has come through a curve, here or already in the control, has noise that the curve has made larger: once.
TEST(RelockDriftNoise, TheNoiseIsThatBehindTheCurve) {
    for (const double slope : {0.5, 2.0})
        EXPECT_DOUBLE_EQ(mean_square_variance(0.003, 0.0, slope), mean_square_variance(0.003 * slope, 0.0, 0.0));
    EXPECT_GT(mean_square_variance(0.003, 2.0, 0.0), mean_square_variance(0.003, 0.5, 0.0));
    EXPECT_EQ(mean_square_variance(0.003, 2.0, 3.0), mean_square_variance(0.003, 2.0, 0.0));
}

FalseAngle by_detuning(const Configured& config, double first_lambda, double second_lambda) {
    RelockDriftState state{.armed = true};
    return step(config, state, {.detuning_first_lambda = first_lambda, .detuning_second_lambda = second_lambda}).tick;
}

// The law of small errors: the slopes of the angle by either mean, from differences of the angle itself.
TEST(RelockDriftNoise, DetuningStatesItsVarianceWhereverTheCentreLies) {
    constexpr double step_lambda = 1e-5;
    for (const double centre : {-0.15, -0.02, 0.0, 0.1})
        for (const double first : {-0.2, 0.05, 0.22})
            for (const double ratio : {0.3, 0.8}) {
                Configured config = configured(RelockMethod::detuning);
                config.gyro.centre = Wavelengths{centre};
                const double second = ratio * first;
                const auto angle = [&](double a, double b) { return by_detuning(config, a, b).value_arcsec; };
                const double by_first =
                    (angle(first + step_lambda, second) - angle(first - step_lambda, second)) / (2.0 * step_lambda);
                const double by_second =
                    (angle(first, second + step_lambda) - angle(first, second - step_lambda)) / (2.0 * step_lambda);
                const double noise_lambda = config.gyro.light_noise.value();
                const double expected = (by_first * by_first + by_second * by_second) * noise_lambda * noise_lambda /
                                        config.gyro.light_samples;
                const FalseAngle found = by_detuning(config, first, second);
                ASSERT_TRUE(found.known);
                EXPECT_NEAR(found.variance_arcsec2 / expected, 1.0, 1e-4) << centre << ' ' << first << ' ' << ratio;
            }
}

// Free-running counter, read at the ends of the halves of an exponential re-lock, with a random start and rotation.
class CountedRelock {
public:
    CountedRelock(Random& random, const Configured& c, double dl0)
        : config_{c}, dl0_{dl0}, phase_{random.uniform(0.0, 1.0)}, rotation_hz_{random.uniform(-4000.0, 4000.0)} {}

    RelockTick next_tick() {
        RelockTick tick{.temperature_c = not_a_number};
        tick.counts_first = advance(1.0);
        tick.counts_second = advance(-1.0);
        return tick;
    }

private:
    std::int64_t advance(double sign) {
        const auto before = std::floor(phase_);
        const double half_s = 0.5 * config_.gyro.tick.value();
        const double decay = std::exp(-half_ / 3.5);  // of dl^2, which decays over two halves of tau
        const double mean_square = dl0_ * dl0_ * decay * 3.5 * (1.0 - std::exp(-1.0 / 3.5));
        phase_ += half_s * (rotation_hz_ + sign * config_.gyro.bias.value() * (1.0 - config_.gyro.chi * mean_square));
        half_ += 1.0;
        return static_cast<std::int64_t>(std::floor(phase_) - before);
    }

    Configured config_;
    double dl0_;
    double phase_;
    double rotation_hz_;
    double half_ = 0.0;
};

struct CountNoise {
    Statistics angle;
    Statistics stated;

    void add(const FalseAngle& out) {
        EXPECT_TRUE(out.known);
        angle.add(out.value_arcsec);
        stated.add(out.variance_arcsec2);
    }
    double ratio() const { return angle.variance() / stated.mean(); }
};

TEST(RelockDriftNoise, FrequencyStatesItsVariance) {
    Random random{1};
    Configured config = configured(RelockMethod::frequency);
    config.gyro.bias = Hertz{6e5};  // rounding small beside the deficits, so that the law is linear in it
    CountNoise by_tick[5];          // the first is that of tick 1
    for (int trial = 0; trial < n_trials; ++trial) {
        CountedRelock relock{random, config, 0.22};
        RelockDriftState state{.armed = true};
        (void)step(config, state, relock.next_tick());
        for (unsigned i = 2; i <= 5; ++i) {
            const RelockDriftOutput out = step(config, state, relock.next_tick());
            if (i == 2) by_tick[0].add(out.first);
            by_tick[i - 1].add(out.tick);
        }
    }
    for (unsigned i = 1; i <= 5; ++i) EXPECT_NEAR(by_tick[i - 1].ratio(), 1.0, tolerance) << "tick " << i;
}

}  // namespace relock_drift_noise_test
