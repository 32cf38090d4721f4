#include <zlg/core/compensation/switch_light.hpp>

#include "support.hpp"

namespace zlg::core::switch_light_test {

constexpr double discriminator = 0.332;
constexpr int halves = 40;
constexpr int samples = 16;

// A half whose light shows a detuning, the same in all samples.
struct Half {
    HalfRecord record;
    std::vector<float> a, b;
};

Half half_at(double detuning_lambda) {
    Half h;
    h.record.detuning_lambda = detuning_lambda;
    h.record.detuning_sq_lambda2 = detuning_lambda * detuning_lambda + 0.0033 * 0.0033;
    for (int k = 0; k < samples; ++k) {
        const double wobble = 1e-6 * (k % 2);
        h.a.push_back(static_cast<float>(1.0 + discriminator * (detuning_lambda + wobble)));
        h.b.push_back(static_cast<float>(1.0 - discriminator * (detuning_lambda + wobble)));
    }
    return h;
}

void take(SwitchLight& state, const Half& half, bool counts, std::int64_t index) {
    step({}, {.discriminator_per_lambda = discriminator}, state, half.record, {.a = half.a, .b = half.b}, counts, index,
         halves);
}

// A gap in the halves from..to-1, or light at one detuning in them.
void in_gap(SwitchLight& state, int from, int to) {
    for (int h = from; h < to; ++h) take(state, half_at(0.3), false, h);
}
void lit(SwitchLight& state, int from, int to, double detuning_lambda = 0.1) {
    for (int h = from; h < to; ++h) take(state, half_at(detuning_lambda), true, h);
}

TEST(SwitchLight, GathersTheHalvesFromTheFirstOneThatCounts) {
    SwitchLight state;
    lit(state, 0, 5, 0.3);
    EXPECT_EQ(state.first_half, -1) << "no gap yet";
    in_gap(state, 5, 12);
    for (int h = 0; h < 60; ++h) {
        EXPECT_EQ(is_complete(state), h >= halves);
        lit(state, 12 + h, 13 + h);
    }
    EXPECT_EQ(state.first_half, 12);
    const LightFit fit{state.sums, 1e-6};
    ASSERT_TRUE(fit.is_known());
    for (int h = 0; h < halves; ++h) EXPECT_NEAR(fit.angle(fit.half(h)), 0.01, 1e-6);
}

// And a complete one is kept until the next one begins: its gap may still wait for its estimate.
TEST(SwitchLight, AnotherGapBeginsItAnew) {
    SwitchLight state;
    in_gap(state, 0, 1);
    lit(state, 1, 9, 0.2);
    in_gap(state, 9, 10);
    EXPECT_FALSE(is_complete(state));
    lit(state, 10, 10 + halves);
    for (int gap = 0; gap < 2; ++gap) {
        EXPECT_TRUE(is_complete(state));
        EXPECT_EQ(state.first_half, 10);
        in_gap(state, 50, 56);
    }
}

// The first whole tick after it is the first one that is corrected: so many of these, to the end of the last.
TEST(SwitchLight, OneThatBeginsWithinATickHasAHalfMore) {
    SwitchLight state;
    in_gap(state, 2, 3);
    lit(state, 3, 3 + halves);
    EXPECT_FALSE(is_complete(state));
    lit(state, 3 + halves, 4 + halves);
    EXPECT_TRUE(is_complete(state));
}

TEST(SwitchLight, LightThatCannotBeReadIsNotComplete) {
    for (const int bad : {0, 7, 39}) {
        SwitchLight state;
        take(state, half_at(0.3), false, 0);
        for (int h = 0; h < 60; ++h) {
            Half half = half_at(0.1);
            if (h == bad) half.a[3] = NAN;
            take(state, half, true, 1 + h);
        }
        EXPECT_FALSE(is_complete(state)) << bad;
    }
}

TEST(RelockProfileConfig, WhatIsMeaninglessIsRefused) {
    EXPECT_TRUE(is_allowed(RelockProfileConfig{}));
    for (const double k : {0.0, std::numeric_limits<double>::quiet_NaN(), 1e7, -1e-7})
        EXPECT_FALSE(is_allowed(RelockProfileConfig{.discriminator_per_lambda = k}));
    EXPECT_FALSE(is_allowed(RelockProfileConfig{.curve = {.n_nodes = 1}}));
}

}  // namespace zlg::core::switch_light_test
