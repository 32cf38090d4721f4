#pragma once
// A gyro whose detuning follows a given course after its loop is closed, and what its light shows of it.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <random>
#include <vector>

#include <zlg/core/compensation/relock_profile.hpp>

namespace relock_test {

using namespace zlg::core;

// Detuning over that at the moment of closing; time in ticks.
using Course = std::function<double(double)>;

inline double exponential_loop(double t) { return std::exp(-t / 3.5); }

// Slew of 0.28 a tick, then a tail of 1.1 ticks.
inline double slew_loop(double t) {
    const double joint = (1.0 - 0.28 * 1.1) / 0.28;
    return t < joint ? 1.0 - 0.28 * t : 0.28 * 1.1 * std::exp(-(t - joint) / 1.1);
}

inline double critical_loop(double t) { return (1.0 + 0.95 * t) * std::exp(-0.95 * t); }

inline double underdamped_loop(double t) {
    const double w = 0.95;
    const double damping = 0.5;
    const double wd = w * std::sqrt(1.0 - damping * damping);
    return std::exp(-damping * w * t) * (std::cos(wd * t) + damping * w / wd * std::sin(wd * t));
}

inline Course dead_loop(double dead_ticks) {
    return [dead_ticks](double t) { return t < dead_ticks ? 1.0 : std::exp(-(t - dead_ticks) / 1.1); };
}

// Of the false angle: scale * T/2 * chi * f0 of the paper's gyro.
inline constexpr double arcsec_per_lambda2 = 3.263 * 0.0025 * 3.6 * 60e3;

inline double true_mean_square(const Course& course, double miss_lambda, int half) {
    constexpr int n = 1000;
    double sum = 0.0;
    for (int i = 0; i < n; ++i) {
        const double dl = miss_lambda * course(0.5 * (half + (i + 0.5) / n));
        sum += dl * dl / n;
    }
    return sum;
}

inline double sign_of(int half) { return half % 2 == 0 ? 1.0 : -1.0; }

// The false angle of all halves together, first half counted positive.
template <class Squares>
double false_angle_arcsec(const Squares& mean_sq_lambda2) {
    double sum = 0.0;
    for (int k = 0; k < profile_halves; ++k)
        sum += sign_of(k) * arcsec_per_lambda2 * mean_sq_lambda2[static_cast<std::size_t>(k)];
    return sum;
}

inline double true_false_angle_arcsec(const Course& course, double miss_lambda) {
    std::array<double, profile_halves> m{};
    for (int k = 0; k < profile_halves; ++k) m[static_cast<std::size_t>(k)] = true_mean_square(course, miss_lambda, k);
    return false_angle_arcsec(m);
}

inline double claimed_variance_arcsec2(const RelockProfile& p) {
    double sum = 0.0;
    for (int k = 0; k < profile_halves; ++k)
        for (int l = 0; l < profile_halves; ++l)
            sum += sign_of(k + l) * p.covariance_lambda4[static_cast<std::size_t>(k)][static_cast<std::size_t>(l)];
    return arcsec_per_lambda2 * arcsec_per_lambda2 * sum;
}

struct HalfSeen {
    HalfRecord record{};
    std::vector<float> a{};
    std::vector<float> b{};
};

struct Gyro {
    Course course = exponential_loop;
    double miss_lambda = 0.22;
    int n = 16;
    double noise_lambda = 0.0033;
    int first_bias_sign = 1;
    int mode = 1;
    double signal_per_lambda = 0.332;
    std::function<double(double)> discriminator = [](double dl) { return dl; };  // apparent detuning of a true one

    // Both photodiodes have noise of their own; that of their difference is `noise_lambda`.
    [[nodiscard]] std::vector<HalfSeen> halves(std::mt19937_64& random) const {
        std::normal_distribution<double> normal;
        std::vector<HalfSeen> all(profile_halves);
        for (int k = 0; k < profile_halves; ++k) {
            HalfSeen& half = all[static_cast<std::size_t>(k)];
            half.record.half = k;
            half.record.bias_sign = static_cast<std::int8_t>(k % 2 == 0 ? first_bias_sign : -first_bias_sign);
            half.record.mode = static_cast<std::int8_t>(mode);
            const double sign = half.record.bias_sign * mode;
            double sum = 0.0;
            double sum_sq = 0.0;
            for (int i = 0; i < n; ++i) {
                const double dl = discriminator(miss_lambda * course(0.5 * (k + (i + 0.5) / n)));
                const double of_a = noise_lambda * normal(random);
                const double of_b = noise_lambda * normal(random);
                half.a.push_back(static_cast<float>(1.0 + signal_per_lambda * (sign * dl + of_a + of_b)));
                half.b.push_back(static_cast<float>(1.0 - signal_per_lambda * (sign * dl + of_a - of_b)));
                const double a = static_cast<double>(half.a.back());
                const double b = static_cast<double>(half.b.back());
                const double seen = sign * (a - b) / (a + b) / signal_per_lambda;
                sum += seen;
                sum_sq += seen * seen;
            }
            half.record.detuning_lambda = sum / n;
            half.record.detuning_sq_lambda2 = sum_sq / n;
        }
        return all;
    }
};

struct Configured {
    CompensationConstants gyro{};
    RelockProfileConfig profile{};
};

inline Configured configured(const Gyro& gyro) {
    Configured config;
    config.profile.discriminator_per_lambda = gyro.signal_per_lambda;
    config.gyro.light_noise = Wavelengths{gyro.noise_lambda};
    config.gyro.light_samples = gyro.n;
    return config;
}

inline RelockProfileState estimated(const Configured& config, const std::vector<HalfSeen>& halves, bool with_b = true) {
    RelockProfileState state;
    enter_gap(state);
    for (const HalfSeen& half : halves)
        step(config.gyro, config.profile, state, half.record,
             {half.a, with_b ? std::span<const float>{half.b} : std::span<const float>{}});
    return state;
}

// Errors of the false angle over trials.
struct Errors {
    double mean = 0.0;
    double sd = 0.0;
    double nev = 0.0;  // mean of the squared error over the claimed variance
};

inline Errors errors_of(const Gyro& gyro, const Configured& config, int trials, bool with_b = true) {
    std::mt19937_64 random{20240607};
    const double truth = true_false_angle_arcsec(gyro.course, gyro.miss_lambda);
    double sum = 0.0;
    double sum_sq = 0.0;
    double nev = 0.0;
    for (int trial = 0; trial < trials; ++trial) {
        const RelockProfile profile = estimated(config, gyro.halves(random), with_b).profile;
        const double error = profile.known ? false_angle_arcsec(profile.mean_sq_lambda2) - truth
                                           : std::numeric_limits<double>::infinity();
        sum += error / trials;
        sum_sq += error * error / trials;
        nev += error * error / claimed_variance_arcsec2(profile) / trials;
    }
    return {sum, std::sqrt(sum_sq - sum * sum), nev};
}

}  // namespace relock_test
