// The profile of the detuning where there is no light, damaged light, or no time: what it falls back to, and when.
#include <zlg/core/compensation/relock_profile.hpp>

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>

#include "relock_profile_support.hpp"

namespace relock_profile_edges_test {

using namespace relock_test;

constexpr float nan_f = std::numeric_limits<float>::quiet_NaN();
constexpr float inf_f = std::numeric_limits<float>::infinity();
constexpr double nan_d = std::numeric_limits<double>::quiet_NaN();

std::vector<HalfSeen> usual_halves() {
    std::mt19937_64 random{3};
    return Gyro{}.halves(random);
}

// As the recorded mean squares say it: without the noise, 4 dl^2 s^2 + 2 s^4 over n, no half with another.
void expect_from_records(const RelockProfile& p, const std::vector<HalfSeen>& halves) {
    const double s2 = 0.0033 * 0.0033;
    ASSERT_TRUE(p.known);
    for (std::size_t k = 0; k < halves.size(); ++k) {
        const double above = halves[k].record.detuning_sq_lambda2 - s2;
        EXPECT_NEAR(p.mean_sq_lambda2[k], above, 1e-15) << k;
        const double variance = (4.0 * std::max(above, 0.0) * s2 + 2.0 * s2 * s2) / 16.0;
        EXPECT_NEAR(p.covariance_lambda4[k][k], variance, 1e-12 * variance) << k;
        for (std::size_t l = 0; l < k; ++l) EXPECT_EQ(p.covariance_lambda4[k][l], 0.0);
    }
}

TEST(RelockProfileEdges, without_light_the_records_are_known_with_the_sixteenth_half) {
    const auto halves = usual_halves();
    RelockProfileState state;
    enter_gap(state);
    for (const HalfSeen& half : halves) {
        EXPECT_FALSE(state.profile.known);
        step({}, {}, state, half.record, {});
    }
    expect_from_records(state.profile, halves);
}

TEST(RelockProfileEdges, with_light_it_is_known_with_the_sixteenth_half_too) {
    const Configured config;
    const auto halves = usual_halves();
    RelockProfileState state;
    enter_gap(state);
    for (const HalfSeen& half : halves) {
        EXPECT_FALSE(state.profile.known);
        step(config.gyro, config.profile, state, half.record, {half.a, half.b});
    }
    EXPECT_TRUE(state.profile.known);
    const RelockProfileState done = state;
    step(config.gyro, config.profile, state, halves[0].record, {halves[0].a, halves[0].b});
    EXPECT_EQ(state, done) << "nothing more to do until the next gap";
}

TEST(RelockProfileEdges, damaged_light_leaves_the_records) {
    const auto good = usual_halves();
    const auto expect_fallback = [&](const char* what, auto&& spoil) {
        SCOPED_TRACE(what);
        for (const std::size_t at : {0u, 1u, 7u, 15u}) {
            auto halves = good;
            spoil(halves[at]);
            expect_from_records(estimated(Configured{}, halves).profile, halves);
        }
    };
    expect_fallback("not a number", [](HalfSeen& h) { h.a[3] = nan_f; });
    expect_fallback("infinite", [](HalfSeen& h) { h.b[15] = inf_f; });
    expect_fallback("dark", [](HalfSeen& h) { h.a[0] = 0.0f; });
    expect_fallback("below dark", [](HalfSeen& h) { h.b[5] = -0.5f; });
    expect_fallback("stuck", [](HalfSeen& h) { std::ranges::fill(h.a, 1.01f); });
    expect_fallback("too few", [](HalfSeen& h) { h.a.resize(15), h.b.resize(15); });
    expect_fallback("of one beam", [](HalfSeen& h) { h.b.resize(15); });
    expect_fallback("none", [](HalfSeen& h) { h.a.clear(), h.b.clear(); });
}

TEST(RelockProfileEdges, a_spike_in_the_first_halves_leaves_the_records) {
    for (const std::size_t at : {0u, 1u}) {
        auto halves = usual_halves();
        halves[at].a[5] *= 1.05f;  // 0.07 wavelength
        expect_from_records(estimated(Configured{}, halves).profile, halves);
    }
}

TEST(RelockProfileEdges, no_other_number_of_samples_than_4_to_64) {
    for (const int n : {3, 65}) {
        std::mt19937_64 random{3};
        const Gyro gyro{.n = n};
        const auto state = estimated(configured(gyro), gyro.halves(random));
        EXPECT_TRUE(state.profile.known);
        EXPECT_EQ(state.n_samples, 0);
    }
    std::mt19937_64 random{3};
    const Gyro gyro{.n = 4};
    EXPECT_EQ(estimated(configured(gyro), gyro.halves(random)).n_samples, 4);
}

TEST(RelockProfileEdges, without_records_and_without_light_nothing_is_known) {
    for (const double spoilt : {nan_d, -1.0, 1e7}) {
        auto halves = usual_halves();
        halves[4].record.detuning_sq_lambda2 = spoilt;
        EXPECT_TRUE(estimated(Configured{}, halves).profile.known) << "by the light";
        halves[9].a[0] = nan_f;
        EXPECT_FALSE(estimated(Configured{}, halves).profile.known) << spoilt;
    }
}

// A mean square of 0 beside noise: the light was not to be trusted.
TEST(RelockProfileEdges, light_that_the_control_refused_is_not_used) {
    auto halves = usual_halves();
    halves[11].record.detuning_lambda = 0.0;
    halves[11].record.detuning_sq_lambda2 = 0.0;
    const RelockProfileState state = estimated(Configured{}, halves);
    EXPECT_EQ(state.n_samples, 0);
    EXPECT_FALSE(state.profile.known);
}

TEST(RelockProfileEdges, one_beam_needs_the_recorded_mean) {
    auto halves = usual_halves();
    halves[2].record.detuning_lambda = nan_d;
    EXPECT_GT(estimated(Configured{}, halves, true).n_samples, 0);
    EXPECT_EQ(estimated(Configured{}, halves, false).n_samples, 0);
}

TEST(RelockProfileEdges, another_gap_begins_anew) {
    const Configured config;
    const auto halves = usual_halves();
    const RelockProfileState expected = estimated(config, halves);
    for (const std::size_t n : {1u, 6u, 12u, 16u}) {
        RelockProfileState state;
        enter_gap(state);
        for (std::size_t k = 0; k < n; ++k)
            step(config.gyro, config.profile, state, halves[k].record, {halves[k].b, halves[k].a});
        enter_gap(state);
        EXPECT_FALSE(state.profile.known);
        for (const HalfSeen& half : halves) step(config.gyro, config.profile, state, half.record, {half.a, half.b});
        EXPECT_EQ(state, expected) << n;
    }
}

TEST(RelockProfileEdges, without_a_gap_nothing_is_taken) {
    RelockProfileState state;
    for (const HalfSeen& half : usual_halves()) step({}, {}, state, half.record, {half.a, half.b});
    EXPECT_EQ(state, RelockProfileState{});
}

// Either polarity of the bias and either helicity show the same detuning.
TEST(RelockProfileEdges, signs_do_not_matter) {
    std::mt19937_64 first{9};
    const RelockProfile expected = estimated(Configured{}, Gyro{}.halves(first)).profile;
    for (const int bias : {1, -1}) {
        for (const int mode : {1, -1}) {
            Gyro gyro{.noise_lambda = 0.0, .first_bias_sign = bias, .mode = mode};
            std::mt19937_64 random{9};
            const RelockProfile p = estimated(Configured{}, gyro.halves(random)).profile;
            for (std::size_t k = 0; k < profile_halves; ++k)
                EXPECT_NEAR(p.mean_sq_lambda2[k], expected.mean_sq_lambda2[k], 1e-3);
        }
    }
}

bool all_finite(const RelockProfile& p) {
    for (std::size_t k = 0; k < profile_halves; ++k) {
        if (!std::isfinite(p.mean_sq_lambda2[k])) return false;
        for (const double x : p.covariance_lambda4[k])
            if (!std::isfinite(x)) return false;
        if (!(p.covariance_lambda4[k][k] >= 0.0)) return false;
    }
    return true;
}

float any_float(std::mt19937_64& random) {
    const auto bits = static_cast<std::uint32_t>(random());
    switch (random() % 4) {
        case 0:
            return std::bit_cast<float>(bits);
        case 1:
            return 1.0f;
        case 2:
            return 1.0f + 1e-9f * static_cast<float>(bits);
        default:
            return std::ldexp(1.0f, static_cast<int>(bits % 250) - 125);
    }
}

TEST(RelockProfileEdges, no_input_brings_anything_but_numbers_into_it) {
    std::mt19937_64 random{77};
    for (int trial = 0; trial < 4000; ++trial) {
        const int n = static_cast<int>(random() % 66);
        const bool mild = random() % 2 == 0;
        Configured config;
        config.gyro.light_noise = Wavelengths{std::ldexp(1.0, static_cast<int>(random() % 60) - 50)};
        if (random() % 4 == 0) config.gyro.light_noise = Wavelengths{0.0};
        config.profile.discriminator_per_lambda =
            std::ldexp(random() % 2 == 0 ? 1.0 : -1.0, static_cast<int>(random() % 38) - 19);
        ASSERT_EQ(check(config.profile), RelockProfileFault::none);
        std::vector<HalfSeen> halves(profile_halves);
        for (HalfSeen& half : halves) {
            const auto sample = [&] { return mild ? std::abs(any_float(random)) : any_float(random); };
            for (int i = 0; i < n; ++i) half.a.push_back(sample()), half.b.push_back(sample());
            half.record.detuning_lambda = static_cast<double>(any_float(random));
            half.record.detuning_sq_lambda2 = static_cast<double>(any_float(random));
        }
        const RelockProfileState state = estimated(config, halves, random() % 2 == 0);
        EXPECT_TRUE(all_finite(state.profile)) << trial;
        EXPECT_EQ(state, state) << "a state that holds what is no number is not itself";
    }
}

TEST(RelockProfileEdges, the_same_light_gives_the_same_bits) {
    const auto halves = usual_halves();
    const RelockProfileState a = estimated(Configured{}, halves);
    const RelockProfileState b = estimated(Configured{}, halves);
    EXPECT_EQ(a, b);
    auto other = halves;
    other[15].a[15] = std::nextafter(other[15].a[15], 2.0f);
    EXPECT_FALSE(estimated(Configured{}, other) == a);
}

TEST(RelockProfileEdges, noise_beyond_a_thousand_wavelengths_is_taken_for_a_thousand) {
    const auto with_noise = [](double noise_lambda) {
        return estimated(Configured{.gyro = {.light_noise = Wavelengths{noise_lambda}}}, usual_halves());
    };
    EXPECT_EQ(with_noise(1e3), with_noise(1e200));
    EXPECT_FALSE(with_noise(999.0) == with_noise(1e3));
}

TEST(RelockProfileEdges, it_is_small) { EXPECT_LT(sizeof(RelockProfileState), 8000u); }

}  // namespace relock_profile_edges_test
