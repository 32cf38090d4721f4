#include <zlg/deviations/series.hpp>
#include <zlg/noise/noise_fit.hpp>

#include "ramp.hpp"
#include "simulated_noise.hpp"

namespace zlg::noise::noise_fit_test {

const FittedTerm& term(const NoiseFit& fit, NoiseKind kind) {
    for (const FittedTerm& t : fit.fitted)
        if (t.kind == kind) return t;
    throw std::runtime_error("no such term");
}

int n_found(const NoiseFit& fit) {
    int n = 0;
    for (const FittedTerm& t : fit.fitted) n += t.found ? 1 : 0;
    return n;
}

void expect_found(const NoiseFit& fit, NoiseKind kind, double truth) {
    const FittedTerm& t = term(fit, kind);
    ASSERT_TRUE(t.found) << name_of(kind);
    EXPECT_NEAR(t.value, truth, 4.0 * t.sigma) << name_of(kind);
    EXPECT_LT(t.sigma, 0.4 * std::abs(truth)) << name_of(kind);
}

TEST(NoiseFit, white_noise_is_angle_random_walk_and_nothing_else) {
    SimulatedNoise gyro(1 << 14, 10.0, 1);
    gyro.add_white(0.3);
    const NoiseFit fit = fit_noise_in_place(gyro.rates, 10.0);
    expect_found(fit, NoiseKind::angle_random_walk, 0.3);
    EXPECT_EQ(n_found(fit), 1);
    EXPECT_GT(fit.probability, 1e-3);
    // A variance of N samples of white noise is known to sqrt(2/N), N to half of that; octaves know nearly as much.
    EXPECT_NEAR(term(fit, NoiseKind::angle_random_walk).sigma, 0.3 / std::sqrt(2.0 * (1 << 14)), 0.3 * 0.002);
}

TEST(NoiseFit, every_smooth_term_that_is_there_is_found) {
    SimulatedNoise gyro(1 << 16, 1.0, 2);
    gyro.add_quantisation(2.0);
    gyro.add_white(1.0);
    gyro.add_random_walk(0.02);
    gyro.add_ramp(0.001);
    const NoiseFit fit = fit_noise_in_place(gyro.rates, 1.0);
    expect_found(fit, NoiseKind::quantisation, 2.0);
    expect_found(fit, NoiseKind::angle_random_walk, 1.0);
    expect_found(fit, NoiseKind::rate_random_walk, 0.02);
    expect_found(fit, NoiseKind::ramp, 0.001);
    EXPECT_EQ(n_found(fit), 4);
}

TEST(NoiseFit, numbers_whose_squares_vanish_or_overflow_are_refused) {
    std::mt19937_64 random{5};
    std::normal_distribution<double> gauss;
    for (const double scale : {1e-100, 1e90}) {
        std::vector<double> rates(640);
        for (double& rate : rates) rate = scale * gauss(random);
        EXPECT_THROW((void)fit_noise_in_place(rates, 1.0), deviations::SeriesError) << scale;
    }
}

TEST(NoiseFit, bias_instability_beside_white_noise) {
    SimulatedNoise gyro(1 << 16, 1.0, 3);
    gyro.add_white(1.0);
    gyro.add_flicker(0.2);
    const NoiseFit fit = fit_noise_in_place(gyro.rates, 1.0);
    expect_found(fit, NoiseKind::angle_random_walk, 1.0);
    expect_found(fit, NoiseKind::bias_instability, 0.2);
    EXPECT_EQ(n_found(fit), 2);
}

TEST(NoiseFit, an_exponentially_correlated_term_with_its_time) {
    SimulatedNoise gyro(1 << 16, 1.0, 4);
    gyro.add_white(1.0);
    gyro.add_markov(0.5, 60.0);
    const NoiseFit fit = fit_noise_in_place(gyro.rates, 1.0);
    expect_found(fit, NoiseKind::markov, 0.5);
    const FittedTerm& t = term(fit, NoiseKind::markov);
    EXPECT_NEAR(t.second, 60.0, 4.0 * t.second_sigma);
    EXPECT_LT(t.second_sigma, 15.0);
    EXPECT_EQ(n_found(fit), 2);
}

TEST(NoiseFit, a_sinusoid_with_its_frequency_and_gaps_left_out) {
    SimulatedNoise gyro(1 << 15, 100.0, 5);
    gyro.add_white(0.1);
    gyro.add_sine(0.5, 7.03);
    for (std::size_t k = 0; k < gyro.rates.size(); ++k)
        if (k % 900 < 20) gyro.rates[k] = std::numeric_limits<double>::quiet_NaN();
    const NoiseFit fit = fit_noise_in_place(gyro.rates, 100.0);
    const FittedTerm& t = term(fit, NoiseKind::sine);
    ASSERT_TRUE(t.found);
    EXPECT_NEAR(t.value, 0.5, 4.0 * t.sigma);
    EXPECT_NEAR(t.second, 7.03, 4.0 * t.second_sigma);
    EXPECT_LT(t.second_sigma, 1e-4);
    expect_found(fit, NoiseKind::angle_random_walk, 0.1);
    EXPECT_EQ(n_found(fit), 2);
}

TEST(NoiseFit, kind_and_unit_of_the_input_do_not_matter) {
    SimulatedNoise gyro(4096, 10.0, 6);
    gyro.add_white(0.3);
    std::vector<double> increments_deg, phase_rad{1.0};
    for (const double r : gyro.rates) {
        increments_deg.push_back(r / 10.0 / 3600.0);
        phase_rad.push_back(phase_rad.back() + r / 10.0 * std::numbers::pi / 648000.0);
    }
    const double n = fit_noise_in_place(gyro.rates, 10.0).terms.angle_random_walk_arcsec_sqrt_s;
    const auto fitted = [](deviations::DataKind kind, deviations::Unit unit, const std::vector<double>& values) {
        return fit_noise(deviations::Series{.what = {kind, unit, 10.0}, .values = values})
            .terms.angle_random_walk_arcsec_sqrt_s;
    };
    EXPECT_NEAR(fitted(deviations::DataKind::increments, deviations::Unit::deg, increments_deg), n, 1e-9);
    EXPECT_NEAR(fitted(deviations::DataKind::phase, deviations::Unit::rad, phase_rad), n, 1e-6);
}

TEST(NoiseFit, an_absent_term_has_a_limit) {
    SimulatedNoise gyro(1 << 14, 1.0, 7);
    gyro.add_white(1.0);
    const NoiseFit fit = fit_noise_in_place(gyro.rates, 1.0);
    for (const NoiseKind kind :
         {NoiseKind::quantisation, NoiseKind::bias_instability, NoiseKind::rate_random_walk, NoiseKind::ramp}) {
        EXPECT_FALSE(term(fit, kind).found);
        EXPECT_GT(term(fit, kind).limit, 0.0) << name_of(kind);
    }
    EXPECT_LT(term(fit, NoiseKind::bias_instability).limit, 0.1);
}

TEST(NoiseFit, leaves_the_rates_without_the_sinusoids_found) {
    SimulatedNoise gyro(1 << 14, 10.0, 8);
    gyro.add_white(1.0);
    gyro.add_sine(50.0, 1.3);
    const NoiseFit fit = fit_noise_in_place(gyro.rates, 10.0);
    ASSERT_EQ(fit.terms.sines.size(), 1u);
    // What is left is white: of deviation 1/sqrt(0.1 s).
    double squares = 0.0;
    for (const double r : gyro.rates) squares += r * r;
    EXPECT_NEAR(squares / static_cast<double>(gyro.rates.size()), 10.0, 0.5);
}

TEST(NoiseFit, a_correlation_longer_than_the_record_is_a_random_walk) {
    SimulatedNoise gyro(1 << 15, 1.0, 9);
    gyro.add_white(1.0);
    const double time_s = 4.0 * (1 << 15);
    gyro.add_markov(0.02 * std::sqrt(time_s / 2.0), time_s);
    const NoiseFit fit = fit_noise_in_place(gyro.rates, 1.0);
    EXPECT_FALSE(term(fit, NoiseKind::markov).found);
    const FittedTerm& walk = term(fit, NoiseKind::rate_random_walk);
    ASSERT_TRUE(walk.found);
    EXPECT_NEAR(walk.value, 0.02, 4.0 * walk.sigma);
    EXPECT_LT(walk.sigma, 0.004);
}

void expect_behind_a_low_pass(NoiseFit fit, double n, double bandwidth_hz) {
    expect_found(fit, NoiseKind::angle_random_walk, n);
    const FittedTerm& white = term(fit, NoiseKind::angle_random_walk);
    EXPECT_LT(white.sigma, 0.05 * n);
    EXPECT_NEAR(white.second, bandwidth_hz, 0.1 * bandwidth_hz);
    EXPECT_NEAR(white.second, bandwidth_hz, 4.0 * white.second_sigma);
    EXPECT_FALSE(term(fit, NoiseKind::markov).found);
    EXPECT_TRUE(std::isnan(white.limit));
    EXPECT_TRUE(fit.describes);
}

TEST(NoiseFit, white_noise_behind_a_low_pass_is_angle_random_walk_with_a_bandwidth) {
    // First order: half of the power at 1/(2 pi T), N = s sqrt(2T).
    SimulatedNoise first(1 << 17, 200.0, 10);
    const double time_s = 0.04;
    first.add_markov(0.3 / std::sqrt(2.0 * time_s), time_s);
    expect_behind_a_low_pass(fit_noise_in_place(first.rates, 200.0), 0.3, 0.5 / (std::numbers::pi * time_s));
    // sinc^2 is a half at 0.443/length.
    SimulatedNoise averaged(1 << 17, 1000.0, 11);
    averaged.add_averaged(0.05, 12);
    expect_behind_a_low_pass(fit_noise_in_place(averaged.rates, 1000.0), 0.05, 443.0 / 12.0);
    SimulatedNoise held(1 << 16, 1000.0, 12);
    held.add_held(0.4, 5);
    expect_behind_a_low_pass(fit_noise_in_place(held.rates, 1000.0), 0.4, 443.0 / 5.0);
}

TEST(NoiseFit, behind_a_low_pass_slow_terms_are_what_they_are) {
    SimulatedNoise gyro(1 << 17, 100.0, 13);
    gyro.add_averaged(1.0, 8);
    gyro.add_random_walk(0.2);
    const NoiseFit fit = fit_noise_in_place(gyro.rates, 100.0);
    expect_behind_a_low_pass(fit, 1.0, 44.3 / 8.0);
    expect_found(fit, NoiseKind::rate_random_walk, 0.2);
    EXPECT_EQ(n_found(fit), 2);
    EXPECT_GT(fit.from_tau_s, 0.04);
}

TEST(NoiseFit, rounding_of_a_counter_is_quantisation_at_long_times_and_no_walk_at_gaps) {
    // Rounding down errs evenly over a count: by count/sqrt(12). Each gap leaves two such errors, which alone would be
    // angle random walk of 2 Q^2 a gap: 0.17 here.
    const double count = 3.263, n = 0.1;
    SimulatedNoise gyro(1 << 17, 200.0, 14);
    gyro.add_counted(9.1, count, 200 * 60);
    gyro.add_white(n);
    const NoiseFit fit = fit_noise_in_place(gyro.rates, 200.0);
    EXPECT_TRUE(fit.describes);
    const FittedTerm& q = term(fit, NoiseKind::quantisation);
    ASSERT_TRUE(q.found);
    EXPECT_NEAR(q.value, count / std::sqrt(12.0), 0.15 * q.value);
    const FittedTerm& white = term(fit, NoiseKind::angle_random_walk);
    EXPECT_LT(white.found ? white.value - 2.0 * white.sigma : 0.0, n);
    EXPECT_GT(white.found ? white.value + 2.0 * white.sigma : white.limit, n);
    EXPECT_GT(fit.from_tau_s, 0.3);
    EXPECT_TRUE(std::isnan(white.second));
}

TEST(NoiseFit, samples_that_are_missing_all_over_leave_the_long_times) {
    SimulatedNoise gyro(1 << 17, 100.0, 31);
    gyro.add_white(0.3);
    gyro.add_random_walk(0.05);
    std::mt19937 engine(2);
    for (double& rate : gyro.rates)
        if (std::bernoulli_distribution{0.3}(engine)) rate = std::nan("");
    const NoiseFit fit = fit_noise_in_place(gyro.rates, 100.0);
    EXPECT_TRUE(fit.describes);
    EXPECT_GT(fit.points.back().tau_s, 100.0);
    for (const auto& [kind, value] :
         {std::pair{NoiseKind::angle_random_walk, 0.3}, {NoiseKind::rate_random_walk, 0.05}}) {
        ASSERT_TRUE(term(fit, kind).found);
        EXPECT_NEAR(term(fit, kind).value, value, 3.0 * term(fit, kind).sigma);
    }
    EXPECT_EQ(n_found(fit), 2);
}

TEST(NoiseFit, a_low_pass_that_rings_is_no_quantisation) {
    for (const double damping : {0.1, 0.3, 0.5}) {
        SimulatedNoise gyro(100000, 100.0, 32);
        gyro.add_white(1.0);
        // y'' + 2 d w y' + w^2 y = w^2 x of 15 Hz by the bilinear rule.
        const double w = 2.0 * std::numbers::pi * 15.0 / 200.0, a = 1.0 + 2.0 * damping * w + w * w;
        double x1 = 0.0, x2 = 0.0, y1 = 0.0, y2 = 0.0;
        for (double& rate : gyro.rates) {
            const double x = rate;
            rate =
                (w * w * (x + 2.0 * x1 + x2) - (2.0 * w * w - 2.0) * y1 - (1.0 - 2.0 * damping * w + w * w) * y2) / a;
            x2 = std::exchange(x1, x);
            y2 = std::exchange(y1, rate);
        }
        const NoiseFit fit = fit_noise_in_place(gyro.rates, 100.0);
        EXPECT_FALSE(term(fit, NoiseKind::quantisation).found) << damping;
        EXPECT_NEAR(term(fit, NoiseKind::angle_random_walk).value, 1.0,
                    3.0 * term(fit, NoiseKind::angle_random_walk).sigma);
    }
}

// Counts of an angle that turns with white noise, as rates of 10 samples a second.
std::vector<double> counted(double rate, double n, double count, std::size_t samples, unsigned seed) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> normal(0.0, n * std::sqrt(0.1));
    std::vector<double> rates(samples);
    double angle = 0.5 * count, before = 0.0;
    for (double& r : rates) {
        angle += rate * 0.1 + normal(engine);
        r = count * (std::floor(angle / count) - before) / 0.1;
        before = std::floor(angle / count);
    }
    return rates;
}

TEST(NoiseFit, a_counter_that_hardly_counts_gives_an_honest_angle_random_walk_or_none) {
    double squares = 0.0, n_found = 0.0;
    for (const double rate : {0.0, 0.3, 1.1})
        for (unsigned seed = 0; seed < 5; ++seed) {
            std::vector<double> rates = counted(rate, 1.0, 3.263, 1 << 17, seed);
            const FittedTerm white = term(fit_noise_in_place(rates, 10.0), NoiseKind::angle_random_walk);
            if (!white.found) continue;
            n_found += 1.0;
            squares += std::pow((white.value - 1.0) / white.sigma, 2);
        }
    EXPECT_GE(n_found, 11.0);
    EXPECT_LT(squares / n_found, 2.0);
    // Where no averaging time is long enough nothing is said.
    std::vector<double> rates = counted(0.1, 0.138, 3.263, 10000, 1);
    const std::string why = test::message_of<deviations::SeriesError>([&] { (void)fit_noise_in_place(rates, 10.0); });
    test::expect_contains(why, "rounding to whole counts");
}

TEST(NoiseFit, refuses_what_tells_nothing) {
    const auto refuses = [](std::vector<double> rates, double rate_hz) {
        EXPECT_THROW((void)fit_noise_in_place(rates, rate_hz), deviations::SeriesError);
    };
    refuses(std::vector<double>(10, 1.0), 1.0);
    refuses(std::vector<double>(1000, 1.0), 1.0);
    refuses(std::vector<double>(1000, std::nan("")), 1.0);
    refuses(std::vector<double>(1000, 1.0), 0.0);
}

TEST(NoiseFit, a_ramp_that_nothing_can_be_weighed_against_is_refused) {
    // Without noise and without steps no covariance is positive: all weights were 0/0, and the limit NaN.
    EXPECT_THROW((void)find_ramp(std::vector<double>(640, 5.0), 1.0, {}), deviations::SeriesError);
    EXPECT_THROW((void)find_ramp(std::vector<double>(640, 0.0), 1.0, {}), deviations::SeriesError);
}

}  // namespace zlg::noise::noise_fit_test
