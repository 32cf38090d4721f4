#include <zlg/core/compensation/switch_light.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace switch_light_test {

using namespace zlg::core;

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

TEST(SwitchLight, GathersTheHalvesFromTheFirstOneThatCounts) {
    SwitchLight state;
    for (int h = 0; h < 5; ++h) take(state, half_at(0.3), true, h);
    EXPECT_EQ(state.first_half, -1) << "no gap yet";
    for (int h = 5; h < 12; ++h) take(state, half_at(0.3), false, h);
    for (int h = 0; h < 60; ++h) {
        EXPECT_EQ(is_complete(state), h >= halves);
        take(state, half_at(0.1), true, 12 + h);
    }
    EXPECT_EQ(state.first_half, 12);
    const LightFit fit{state.sums, 1e-6};
    ASSERT_TRUE(fit.is_known());
    for (int h = 0; h < halves; ++h) EXPECT_NEAR(fit.angle(fit.half(h)), 0.01, 1e-6);
}

TEST(SwitchLight, AnotherGapBeginsItAnew) {
    SwitchLight state;
    take(state, half_at(0.3), false, 0);
    for (int h = 1; h < 9; ++h) take(state, half_at(0.2), true, h);
    take(state, half_at(0.3), false, 9);
    EXPECT_FALSE(is_complete(state));
    for (int h = 10; h < 10 + halves; ++h) take(state, half_at(0.1), true, h);
    EXPECT_TRUE(is_complete(state));
    EXPECT_EQ(state.first_half, 10);
}

// The first whole tick after it is the first one that is corrected: so many of these, to the end of the last.
TEST(SwitchLight, OneThatBeginsWithinATickHasAHalfMore) {
    SwitchLight state;
    take(state, half_at(0.3), false, 2);
    for (int h = 3; h < 3 + halves; ++h) take(state, half_at(0.1), true, h);
    EXPECT_FALSE(is_complete(state));
    take(state, half_at(0.1), true, 3 + halves);
    EXPECT_TRUE(is_complete(state));
}

// A complete one is kept until the next one begins: its gap may still wait for its estimate.
TEST(SwitchLight, IsKeptThroughTheNextGap) {
    SwitchLight state;
    take(state, half_at(0.3), false, 1);
    for (int h = 2; h < 2 + halves; ++h) take(state, half_at(0.1), true, h);
    for (int h = 0; h < 6; ++h) take(state, half_at(0.3), false, 42 + h);
    EXPECT_TRUE(is_complete(state));
    EXPECT_EQ(state.first_half, 2);
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

}  // namespace switch_light_test
