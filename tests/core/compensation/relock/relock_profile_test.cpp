// The profile of the detuning after re-lock: its errors against loops of every kind and against the bound, and what it says
// of them.
#include <zlg/core/compensation/relock_profile.hpp>

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "relock_profile_support.hpp"

namespace relock_profile_test {

using namespace relock_test;

struct NamedLoop {
    std::string name;
    Course course;
    double published_bound_arcsec;  // with 16 samples of 0.0033 wavelength, from 0.22; 0: none for this one
};

std::vector<NamedLoop> loops() {
    return {{"exponential", exponential_loop, 0.73},
            {"slew with tail", slew_loop, 0.72},
            {"critical", critical_loop, 0.75},
            {"underdamped", underdamped_loop, 0.73},
            {"dead time", dead_loop(0.5), 0.0}};
}

// Solve a symmetric positive definite system in place.
std::vector<long double> solved(std::vector<std::vector<long double>> a, std::vector<long double> b) {
    const std::size_t n = b.size();
    for (std::size_t k = 0; k < n; ++k)
        for (std::size_t i = k + 1; i < n; ++i) {
            const long double factor = a[i][k] / a[k][k];
            for (std::size_t j = k; j < n; ++j) a[i][j] -= factor * a[k][j];
            b[i] -= factor * b[k];
        }
    for (std::size_t k = n; k-- > 0;) {
        for (std::size_t j = k + 1; j < n; ++j) b[k] -= a[k][j] * b[j];
        b[k] /= a[k][k];
    }
    return b;
}

std::vector<long double> spline_terms(double t) {
    std::vector<long double> terms{1.0L, t, t * t, t * t * t};
    for (double knot = 0.5; knot < 7.6; knot += knot < 5.9 ? 0.5 : 1.0) {
        const long double past = t > knot ? t - knot : 0.0;
        terms.push_back(past * past * past);
    }
    return terms;
}

// Cramer and Rao's bound of the false angle at the true course, for a cubic spline with knots every half a tick to 6 ticks
// and wider after: standard deviation.
double bound_arcsec(const Course& course, double miss_lambda, int n, double noise_lambda) {
    const std::size_t size = spline_terms(0.0).size();
    std::vector<std::vector<long double>> information(size, std::vector<long double>(size));
    std::vector<long double> slope(size);
    for (int i = 0; i < n * profile_halves; ++i) {
        const auto terms = spline_terms(0.5 * (i + 0.5) / n);
        for (std::size_t a = 0; a < size; ++a)
            for (std::size_t b = 0; b < size; ++b) information[a][b] += terms[a] * terms[b];
    }
    constexpr int fine = 200;
    for (int i = 0; i < fine * profile_halves; ++i) {
        const double t = 0.5 * (i + 0.5) / fine;
        const auto terms = spline_terms(t);
        const double by_detuning = sign_of(i / fine) * 2.0 * miss_lambda * course(t) / fine;
        for (std::size_t a = 0; a < size; ++a) slope[a] += by_detuning * terms[a];
    }
    const auto x = solved(information, slope);
    long double sum = 0.0;
    for (std::size_t a = 0; a < size; ++a) sum += slope[a] * x[a];
    return arcsec_per_lambda2 * noise_lambda * std::sqrt(static_cast<double>(sum));
}

TEST(RelockProfile, the_bound_of_this_test_is_the_published_one) {
    for (const NamedLoop& loop : loops()) {
        if (loop.published_bound_arcsec == 0.0) continue;
        EXPECT_NEAR(bound_arcsec(loop.course, 0.22, 16, 0.0033), loop.published_bound_arcsec, 0.01) << loop.name;
    }
}

TEST(RelockProfile, every_loop_is_unbiased_and_near_the_bound) {
    constexpr int trials = 1500;
    for (const NamedLoop& loop : loops()) {
        const Gyro gyro{.course = loop.course};
        const Errors found = errors_of(gyro, configured(gyro), trials);
        EXPECT_LT(std::abs(found.mean), 0.2) << loop.name;
        EXPECT_LT(found.sd, 1.25 * bound_arcsec(loop.course, 0.22, 16, 0.0033)) << loop.name;
        EXPECT_GT(found.nev, 0.8) << loop.name;
        EXPECT_LT(found.nev, 1.2) << loop.name;
    }
}

TEST(RelockProfile, no_dead_time_of_the_first_tick_biases_it) {
    constexpr int trials = 600;
    for (const double dead_ticks : {0.1, 0.25, 0.4, 0.6, 0.7, 0.9, 1.0}) {
        for (const bool slews : {false, true}) {
            const Course slow = [dead_ticks](double t) { return slew_loop(std::max(t - dead_ticks, 0.0)); };
            const Gyro gyro{.course = slews ? slow : dead_loop(dead_ticks)};
            const Errors found = errors_of(gyro, configured(gyro), trials);
            EXPECT_LT(std::abs(found.mean), 0.2 + 3.0 * found.sd / std::sqrt(trials)) << dead_ticks << slews;
            EXPECT_LT(found.nev, 1.4) << dead_ticks << slews;
        }
    }
}

TEST(RelockProfile, holds_for_other_misses_signs_and_numbers_of_samples) {
    constexpr int trials = 400;
    const double scatter = 1.0 + 2.0 / std::sqrt(2.0 * trials);  // of a standard deviation found in so many, twice
    for (const NamedLoop& loop : loops()) {
        for (const auto& [miss_lambda, n] : std::vector<std::pair<double, int>>{
                 {0.05, 16}, {0.1, 16}, {0.3, 16}, {-0.22, 16}, {0.22, 8}, {0.22, 25}, {-0.22, 64}}) {
            const Gyro gyro{.course = loop.course,
                            .miss_lambda = miss_lambda,
                            .n = n,
                            .first_bias_sign = n == 25 ? -1 : 1,
                            .mode = n == 8 ? -1 : 1};
            const Errors found = errors_of(gyro, configured(gyro), trials);
            const double allowed = 0.2 * std::max(1.0, miss_lambda * miss_lambda / (0.22 * 0.22));
            EXPECT_LT(std::abs(found.mean), allowed + 2.0 * found.sd / std::sqrt(trials))
                << loop.name << ' ' << miss_lambda << ' ' << n;
            EXPECT_LT(found.sd, scatter * 1.25 * bound_arcsec(loop.course, miss_lambda, n, gyro.noise_lambda))
                << loop.name << ' ' << miss_lambda << ' ' << n;
            EXPECT_GT(found.nev, 0.6) << loop.name << ' ' << miss_lambda << ' ' << n;
            EXPECT_LT(found.nev, 1.5) << loop.name << ' ' << miss_lambda << ' ' << n;
        }
    }
}

// Of any combination of halves, not of the false angle alone.
TEST(RelockProfile, its_covariance_is_that_of_its_errors) {
    constexpr int trials = 2500;
    const Gyro gyro{.course = dead_loop(0.5)};
    const auto weight = [](int what, int k) {
        if (what < profile_halves) return k == what ? 1.0 : 0.0;
        if (what == profile_halves) return 1.0;
        return (k / 2) % 2 == 0 ? 1.0 : -0.5 * k;
    };
    constexpr int n_what = profile_halves + 2;
    std::array<double, n_what> found{};
    std::array<double, n_what> claimed{};
    std::array<double, profile_halves> truth{};
    for (int k = 0; k < profile_halves; ++k)
        truth[static_cast<std::size_t>(k)] = true_mean_square(gyro.course, 0.22, k);
    std::mt19937_64 random{11};
    for (int trial = 0; trial < trials; ++trial) {
        const RelockProfile p = estimated(configured(gyro), gyro.halves(random)).profile;
        ASSERT_TRUE(p.known);
        for (int what = 0; what < n_what; ++what) {
            double error = 0.0;
            double variance = 0.0;
            for (int k = 0; k < profile_halves; ++k) {
                const auto i = static_cast<std::size_t>(k);
                error += weight(what, k) * (p.mean_sq_lambda2[i] - truth[i]);
                for (int l = 0; l < profile_halves; ++l)
                    variance +=
                        weight(what, k) * weight(what, l) * p.covariance_lambda4[i][static_cast<std::size_t>(l)];
            }
            found[static_cast<std::size_t>(what)] += error * error / trials;
            claimed[static_cast<std::size_t>(what)] += variance / trials;
        }
    }
    for (std::size_t what = 0; what < n_what; ++what) {
        // In the last halves the detuning is below the noise. The variance of the square of what has four coefficients is
        // claimed as if these were one: up to four times too large.
        const double most = what < 8 || what >= profile_halves ? 1.2 : 4.0 * 1.2;
        EXPECT_LT(found[what], 1.2 * claimed[what]) << what;
        EXPECT_GT(found[what], claimed[what] / most) << what;
    }
}

// A loop that steps once a half bends at each border, which no chain of cubics does: the estimate must notice, or be biased.
TEST(RelockProfile, a_loop_that_steps_leaves_the_recorded_squares) {
    const Course steps = [](double t) {
        const double half = std::floor(2.0 * t);
        const double before = std::max(0.0, 1.0 - 0.16 * half);
        const double after = std::max(0.0, 1.0 - 0.16 * (half + 1.0));
        return after + (before - after) * std::exp(-(2.0 * t - half) / 0.4);
    };
    constexpr int trials = 600;
    const Gyro gyro{.course = steps};
    int n_by_light = 0;
    std::mt19937_64 random{5};
    for (int trial = 0; trial < trials; ++trial)
        n_by_light += estimated(configured(gyro), gyro.halves(random)).n_samples > 0 ? 1 : 0;
    EXPECT_LT(n_by_light, trials / 4);
    const Errors found = errors_of(gyro, configured(gyro), trials);
    EXPECT_LT(std::abs(found.mean), 0.2 + 2.0 * found.sd / std::sqrt(trials));
    EXPECT_LT(found.nev, 1.4);
}

// Knots at the borders of the halves do not bend a single cubic, and without noise there is nothing to average.
TEST(RelockProfile, a_cubic_without_noise_is_exact) {
    Gyro gyro{.course = [](double t) { return 1.0 - 0.3 * t + 0.04 * t * t - 0.0018 * t * t * t; },
              .noise_lambda = 0.0};
    std::mt19937_64 random{1};
    const RelockProfile p = estimated(configured(gyro), gyro.halves(random)).profile;
    ASSERT_TRUE(p.known);
    for (int k = 0; k < profile_halves; ++k)
        EXPECT_NEAR(p.mean_sq_lambda2[static_cast<std::size_t>(k)], true_mean_square(gyro.course, 0.22, k), 3e-7) << k;
}

TEST(RelockProfile, one_beam_will_do_with_a_larger_sigma) {
    const Gyro gyro{.course = slew_loop};
    const Errors both = errors_of(gyro, configured(gyro), 800);
    const Errors one = errors_of(gyro, configured(gyro), 800, false);
    EXPECT_LT(std::abs(one.mean), 0.2 + 2.0 * one.sd / std::sqrt(800.0));
    EXPECT_LT(one.sd, 1.5 * both.sd);
    EXPECT_GT(one.nev, 0.4) << "the recorded mean comes from both beams: better than what is claimed";
    EXPECT_LT(one.nev, 1.2);
}

// dl = x (1 - 2 x^2)  <=>  the light shows more than it should.
TEST(RelockProfile, the_curve_of_the_discriminator_is_taken_out) {
    constexpr auto true_of = [](double x) { return x * (1.0 - 2.0 * x * x); };
    const auto apparent_of = [&](double dl) {
        double x = dl;
        for (int k = 0; k < 60; ++k) x = dl + 2.0 * x * x * x;
        return x;
    };
    const Gyro gyro{.course = slew_loop, .miss_lambda = 0.15, .discriminator = apparent_of};
    std::vector<double> apparent;
    std::vector<double> detuning;
    for (int k = 1; k <= 20; ++k) {
        apparent.push_back(0.0125 * k);
        detuning.push_back(true_of(apparent.back()));
    }
    Configured config = configured(gyro);
    EXPECT_GT(std::abs(errors_of(gyro, config, 100).mean), 1.0) << "without the curve";
    config.profile.curve = discriminator_curve(apparent, detuning);
    config.gyro.record_curve = config.profile.curve;  // the records of this gyro are made by the slope alone
    ASSERT_EQ(check(config.profile), RelockProfileFault::none);
    const Errors found = errors_of(gyro, config, 800);
    EXPECT_LT(std::abs(found.mean), 0.1 + 2.0 * found.sd / std::sqrt(800.0));
    EXPECT_GT(found.nev, 0.6);
    EXPECT_LT(found.nev, 1.5);
}

TEST(RelockProfile, noise_other_than_configured_is_seen_in_the_light) {
    const Gyro gyro{};
    for (const double presumed : {0.0, 0.001, 0.02}) {
        Configured config = configured(gyro);
        config.gyro.light_noise = Wavelengths{presumed};
        std::mt19937_64 random{5};
        double claimed = 0.0;
        int n_by_light = 0;
        for (int trial = 0; trial < 300; ++trial) {
            const RelockProfileState s = estimated(config, gyro.halves(random));
            if (s.n_samples == 0) continue;
            ++n_by_light;
            claimed += claimed_variance_arcsec2(s.profile);
        }
        EXPECT_GT(n_by_light, 270);
        EXPECT_NEAR(std::sqrt(claimed / n_by_light), 0.70, 0.12) << presumed;
    }
}

}  // namespace relock_profile_test
