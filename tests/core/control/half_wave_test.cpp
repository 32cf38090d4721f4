#include <zlg/core/control/half_wave.hpp>

#include "support.hpp"

namespace zlg::core::half_wave_test {

constexpr HalfWaveConfig config{};

static_assert(check(config) == HalfWaveFault::none);
static_assert(check(HalfWaveConfig{.presumed = Volts{0.0}}) == HalfWaveFault::presumed);
static_assert(check(HalfWaveConfig{.presumed = Volts{not_a_number}}) == HalfWaveFault::presumed);
static_assert(check(HalfWaveConfig{.presumed_sigma_ratio = 1.0}) == HalfWaveFault::presumed_sigma);
static_assert(check(HalfWaveConfig{.measurement_sigma = Volts{0.0}}) == HalfWaveFault::measurement_sigma);
static_assert(check(HalfWaveConfig{.process_sigma = Volts{-1.0}}) == HalfWaveFault::process_sigma);
static_assert(check(HalfWaveConfig{.gate = not_a_number}) == HalfWaveFault::gate);

TEST(HalfWave, OneMeasurementIsTheWeightedMeanOfPresumedAndMeasured) {
    HalfWaveState s = initial_state(config);
    const HalfWaveOutput out = step(config, s, Volts{42.0});
    // Inverse variances: presumed 1/(16) (its ceiling: process noise adds nothing), measured 1/(0.09).
    const double weight_presumed = 1.0 / 16.0;
    const double weight_measured = 1.0 / 0.09;
    const double sum = weight_presumed + weight_measured;
    EXPECT_NEAR(out.half_wave.value(), (40.0 * weight_presumed + 42.0 * weight_measured) / sum, 1e-12);
    EXPECT_NEAR(sigma(s).value(), std::sqrt(1.0 / sum), 1e-12);
    EXPECT_EQ(s.n_accepted, 1);
    EXPECT_FALSE(out.rejected);
}

TEST(HalfWave, SteadySigmaSolvesTheRiccatiEquation) {
    HalfWaveState s = initial_state(config);
    for (int k = 0; k < 300; ++k) (void)step(config, s, Volts{40.0});
    // P^2 + q P - q r = 0 for the posterior variance P.
    const double q = 0.01;
    const double r = 0.09;
    const double posterior = 0.5 * (-q + std::sqrt(q * q + 4.0 * q * r));
    EXPECT_NEAR(s.variance_v2, posterior, 1e-12);
}

TEST(HalfWave, OutliersAreRejectedAndSaid) {
    HalfWaveState s = initial_state(config);
    for (int k = 0; k < 20; ++k) (void)step(config, s, Volts{40.0});
    const double held_v = s.estimate_v;
    for (const double wrong_v : {not_a_number, 1.0 / 0.0, -1.0 / 0.0, 1e300, 0.0, -40.0, 42.0, 19.0, 81.0}) {
        const double before_v2 = s.variance_v2;
        EXPECT_TRUE(step(config, s, Volts{wrong_v}).rejected) << wrong_v;
        EXPECT_EQ(s.estimate_v, held_v);
        EXPECT_GT(s.variance_v2, before_v2);
    }
    EXPECT_EQ(s.n_accepted, 20);
}

TEST(HalfWave, ASecondOutlierOnTheSameSideIsBelieved) {
    HalfWaveState s = initial_state(config);
    for (int k = 0; k < 20; ++k) (void)step(config, s, Volts{34.0});
    EXPECT_TRUE(step(config, s, Volts{38.0}).rejected);
    EXPECT_TRUE(step(config, s, Volts{30.0}).rejected);  // the other side begins anew
    EXPECT_TRUE(step(config, s, Volts{38.0}).rejected);
    EXPECT_TRUE(step(config, s, Volts{100.0}).rejected);  // another mode is no second one
    EXPECT_FALSE(step(config, s, Volts{38.5}).rejected);
    // p = 4.5^2 against 0.3^2.
    EXPECT_NEAR(s.estimate_v, 34.0 + 4.5 * 20.25 / 20.34, 1e-6);
    EXPECT_NEAR(sigma(s).value(), std::sqrt(0.09 * 20.25 / 20.34), 1e-7);
}

TEST(HalfWave, AnotherModeIsNoNeighbourHoweverWideTheGate) {
    const HalfWaveConfig unsure{.presumed_sigma_ratio = 0.9};
    HalfWaveState s = initial_state(unsure);
    EXPECT_TRUE(step(unsure, s, Volts{81.0}).rejected);
    EXPECT_TRUE(step(unsure, s, Volts{19.0}).rejected);
    EXPECT_FALSE(step(unsure, s, Volts{79.0}).rejected);
}

TEST(HalfWave, WithoutMeasurementsTheSigmaGrowsToThatOfThePresumedValue) {
    HalfWaveState s = initial_state(config);
    (void)step(config, s, Volts{40.0});
    for (int k = 0; k < 10000; ++k) (void)step(config, s, Volts{not_a_number});
    EXPECT_DOUBLE_EQ(sigma(s).value(), 4.0);
}

struct Place {
    PiezoRange range;
    double piezo_v;
    int sign;  // 0: either
    bool out_of_range = false;
};

// The room is what lies between the neighbour, 40 V away, and the end of the range, wherever that begins. Where neither keeps the
// margin the roomier one is taken, and said.
TEST(HalfWave, DirectionLeadsTowardsTheMiddleOfTheRange) {
    constexpr PiezoRange whole{};
    constexpr PiezoRange raised{.min = Volts{100.0}, .max = Volts{300.0}, .margin = Volts{5.0}};
    constexpr PiezoRange narrow{.min = Volts{0.0}, .max = Volts{80.0}, .margin = Volts{5.0}};
    for (const Place& place :
         {Place{whole, 120.0, 1}, Place{whole, 180.0, -1}, Place{whole, 5.0, 1}, Place{whole, 295.0, -1},
          Place{whole, 150.0, 0}, Place{raised, 180.0, 1}, Place{raised, 220.0, -1}, Place{narrow, 38.0, 1, true},
          Place{narrow, 42.0, -1, true}, Place{narrow, 35.0, 0}}) {  // the last one lands on the margin itself
        const SwitchDirection direction = choose_direction(place.range, Volts{place.piezo_v}, Volts{40.0});
        if (place.sign != 0) EXPECT_EQ(direction.sign, place.sign) << place.piezo_v;
        EXPECT_EQ(direction.out_of_range, place.out_of_range) << place.piezo_v;
    }
}

}  // namespace zlg::core::half_wave_test
