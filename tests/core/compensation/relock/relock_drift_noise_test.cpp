// The variance that the re-lock correction states, against trials with noise and the law of small errors.
#include "relock_drift_support.hpp"

namespace zlg::core::relock_drift_support::drift_noise_test {

constexpr int n_trials = 20'000;  // the scatter of a variance is then 1 %
constexpr double tolerance = 0.05;

// Mean square of noisy samples of dl0 exp(-t/tau) over a half of the decay, as the electronics make them.
double sampled_square(Random& random, const CompensationConstants& gyro, double dl0, double half) {
    double sum = 0.0;
    for (int k = 0; k < gyro.light_samples; ++k) {
        const double t_ticks = 0.5 * (half + (k + 0.5) / gyro.light_samples);
        const double sample = dl0 * std::exp(-t_ticks / 3.5) + gyro.light_noise.value() * random.normal();
        sum += sample * sample / gyro.light_samples;
    }
    return sum;
}

TEST(RelockDriftNoise, MeanSquareStatesItsVariance) {
    for (const double dl0 : {0.22, -0.1, 0.02, 0.01})
        for (const int light_samples : {1, 16, 25}) {
            Random random{static_cast<std::uint64_t>(light_samples) + 7};
            Configured config = configured(RelockMethod::mean_square);
            config.gyro.light_samples = light_samples;
            Statistics angle;
            Statistics stated;
            for (int trial = 0; trial < n_trials; ++trial) {
                RelockDriftState state{.armed = true};
                const Tick tick{.detuning_sq_first_lambda2 = sampled_square(random, config.gyro, dl0, 0.0),
                                .detuning_sq_second_lambda2 = sampled_square(random, config.gyro, dl0, 1.0)};
                const FalseAngle out = step(config, state, tick).tick;
                EXPECT_TRUE(out.known);
                angle.add(out.value_arcsec);
                stated.add(out.variance_arcsec2);
            }
            EXPECT_NEAR(angle.variance() / stated.mean(), 1.0, tolerance) << dl0 << ' ' << light_samples;
        }
}

DiscriminatorCurve straight(double slope) {
    const double apparent[] = {0.5}, detuning[] = {0.5 * slope};
    return discriminator_curve(apparent, detuning);
}

double mean_square_variance(double noise_lambda, double own_slope, double control_slope) {
    Configured config = configured(RelockMethod::mean_square);
    config.gyro.light_noise = Wavelengths{noise_lambda};
    if (own_slope > 0.0) config.gyro.record_curve = straight(own_slope);
    if (control_slope > 0.0) config.gyro.control_curve = straight(control_slope);
    RelockDriftState state{.armed = true};
    return step(config, state,
                {.detuning_first_lambda = 0.1,
                 .detuning_second_lambda = 0.08,
                 .detuning_sq_first_lambda2 = 0.0102,
                 .detuning_sq_second_lambda2 = 0.0065})
        .tick.variance_arcsec2;
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

// Ticks 1..i of a decaying deficit with a count so fine that derivatives by it are differences of one of a thousand.
struct Decay {
    Configured config{.gyro = {.bias = Hertz{1e12}}, .relock = {.method = RelockMethod::frequency}};
    std::vector<std::int64_t> difference;  // c_first - c_second

    explicit Decay(int i) {
        for (int k = 1; k <= i; ++k) difference.push_back(std::llround(0.005 * (1e12 - 1e11 * std::pow(0.6, k))));
    }

    RelockDriftOutput last() const {
        RelockDriftState state{.armed = true};
        RelockDriftOutput out;
        for (const std::int64_t d : difference)
            out = step(config, state, {.counts_first = d, .temperature_c = not_a_number});
        return out;
    }
};

double tick_value(const RelockDriftOutput& out) { return out.tick.value_arcsec; }
double first_value(const RelockDriftOutput& out) { return out.first.value_arcsec; }

// By the count difference of tick k, from 0.
double slope(const Decay& decay, std::size_t k, double (*value)(const RelockDriftOutput&)) {
    constexpr std::int64_t few = 100'000;
    Decay less = decay;
    Decay more = decay;
    less.difference[k] -= few;
    more.difference[k] += few;
    return (value(more.last()) - value(less.last())) / (2.0 * few);
}

// c_first - c_second = 2 r_1 - r_0 - r_2 of the readings r at the borders of the halves; each is rounded uniformly.
double variance_by_readings(double by_first_tick, double by_this_tick, bool neighbours) {
    const double a = by_first_tick;
    const double b = by_this_tick;
    if (neighbours) return (a * a + 4.0 * a * a + (a + b) * (a + b) + 4.0 * b * b + b * b) / 12.0;
    return 6.0 * (a * a + b * b) / 12.0;
}

TEST(RelockDriftNoise, FrequencyStatesTheVarianceOfTheRoundingOfEveryReading) {
    for (const int i : {2, 3, 5}) {
        const Decay decay{i};
        const double by_first = slope(decay, 0, tick_value);
        const double by_last = slope(decay, static_cast<std::size_t>(i) - 1, tick_value);
        const double expected = variance_by_readings(by_first, by_last, i == 2);
        EXPECT_NEAR(decay.last().tick.variance_arcsec2 / expected, 1.0, 1e-5) << "tick " << i;
    }
    const Decay two{2};
    const double expected = variance_by_readings(slope(two, 0, first_value), slope(two, 1, first_value), true);
    EXPECT_NEAR(two.last().first.variance_arcsec2 / expected, 1.0, 1e-5);
}

}  // namespace zlg::core::relock_drift_support::drift_noise_test
