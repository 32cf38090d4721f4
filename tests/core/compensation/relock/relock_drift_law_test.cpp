// When a tick is corrected, when it cannot be, and what `check` refuses.
#include "relock_drift_support.hpp"

namespace zlg::core::relock_drift_support::drift_law_test {

// A tick with a deficit of `deficit_hz` below 60 kHz, and usable detunings.
Tick tick_of(double deficit_hz) {
    const std::int64_t counts = std::llround(0.5 * 0.005 * (60e3 - deficit_hz));
    return {.sign = 1,
            .counts_first = counts,
            .counts_second = -counts,
            .detuning_first_lambda = 0.1,
            .detuning_second_lambda = 0.08,
            .detuning_sq_first_lambda2 = 0.01,
            .detuning_sq_second_lambda2 = 0.0064,
            .temperature_c = not_a_number};
}

void expect_unknown(RelockMethod method, const Tick& tick) {
    RelockDriftState state{.armed = true};
    const RelockDriftOutput out = step(configured(method), state, tick);
    EXPECT_TRUE(out.due);
    EXPECT_FALSE(out.tick.known);
    EXPECT_EQ(out.tick.value_arcsec, 0.0);
    EXPECT_TRUE(out.tick.variance_arcsec2 >= 0.0 && std::isfinite(out.tick.variance_arcsec2));
}

// u of a mean square.
constexpr double u_arcsec = 3.6 * 60e3 * 3.263 * 0.0025;

double missing_arcsec(RelockMethod method, RelockDriftState& state, const Tick& tick) {
    const RelockDriftOutput out = step(configured(method), state, tick);
    EXPECT_TRUE(out.due && !out.tick.known);
    return std::sqrt(out.tick.variance_arcsec2);
}

// What is left in tick n is at most 1/(2n - 1) of what the detuning may be, and no more than the light of its first
// half shows.
TEST(RelockDriftLaw, ATickThatIsNotCorrectedClaimsWhatMayBeMissing) {
    const RelockMethod method = RelockMethod::mean_square;
    RelockDriftState state;
    enter_gap(state);
    for (int n = 1; n <= 5; ++n)
        EXPECT_NEAR(missing_arcsec(method, state, {}), u_arcsec * 0.5 * 0.25 * 0.25 / (2 * n - 1), 1e-9);
    Tick half_seen;
    half_seen.detuning_sq_first_lambda2 = 0.01;
    half_seen.detuning_sq_second_lambda2 = not_a_number;
    EXPECT_NEAR(missing_arcsec(method, state, half_seen), u_arcsec * 0.01, 1e-9);
    // A mean alone: half of the mean square of a half in which the detuning falls to a thirtieth.
    half_seen = {};
    half_seen.detuning_first_lambda = 0.05;
    EXPECT_NEAR(missing_arcsec(method, state, half_seen), u_arcsec * 2.0 * 0.05 * 0.05, 1e-9);
    Configured config = configured(method);
    config.gyro.centre = Wavelengths{0.03};
    half_seen.detuning_sq_second_lambda2 = not_a_number;
    EXPECT_NEAR(std::sqrt(step(config, state, half_seen).tick.variance_arcsec2), u_arcsec * 2.0 * 0.02 * 0.02, 1e-9);
}

// For every exponential loop and every miss that can be caught, whichever half is blind, it is within two such sigmas.
TEST(RelockDriftLaw, WhatIsMissingIsWithinWhatIsClaimed) {
    const auto seen = [](bool is_blind, double lambda2) { return is_blind ? -1.0 : lambda2; };
    for (const RelockMethod method : {RelockMethod::mean_square, RelockMethod::detuning})
        for (const double q : {0.02, 0.1, 0.5, 0.8, 0.9, 0.99})
            for (const double miss : {0.05, 0.22})
                for (const int blind : {1, 2, 3}) {
                    RelockDriftState state;
                    enter_gap(state);
                    for (int n = 1; n <= 20; ++n) {
                        const double first = miss * miss * std::pow(q, 4 * (n - 1)), second = first * q * q;
                        const Tick tick{.detuning_first_lambda = blind != 2 ? 0.0 : std::sqrt(first),
                                        .detuning_second_lambda = blind != 1 ? 0.0 : std::sqrt(second),
                                        .detuning_sq_first_lambda2 = seen(blind != 2, first),
                                        .detuning_sq_second_lambda2 = seen(blind != 1, second)};
                        EXPECT_LE(u_arcsec * (first - second), 2.0 * missing_arcsec(method, state, tick) + 1e-12)
                            << q << ", tick " << n;
                    }
                }
}

// Deficits, in counts, of tick 1 and of a tick 2 that names no decay; and of 2 what is claimed of either. A deficit
// bounds the false rate. By counts its rounding has a standard deviation of one count, within which it is none; by
// phase the light knows better.
TEST(RelockDriftLaw, FrequencyClaimsTheDeficitThatItCannotRead) {
    constexpr double scale = 3.263, light = u_arcsec * 0.0004 / scale, most = u_arcsec * 0.03125 / scale;
    struct Case {
        bool by_phase;
        double lambda2, first, second, claimed_first, claimed_second;
    };
    for (const Case& c : {Case{false, 0.0, 0.95, 2.85, 0.0, 2.85},
                          {false, 0.0, 1.001, 3.003, 1.001, 3.003},
                          {false, 0.0, 0.2, -0.2, 0.0, 0.0},
                          {false, 0.0, 90.0, 100.0, most, most / 3.0},
                          {false, 0.0004, 1.001, 3.003, light, light},
                          {true, 0.0, 0.2, -0.3, 0.2, 0.3},
                          {true, 0.0, 90.0, 100.0, most, most / 3.0},
                          {true, 0.0004, 0.01, 0.02, light, light}}) {
        RelockDriftState state;
        enter_gap(state);
        Tick tick{.counts_first = 150,
                  .counts_second = -150,
                  .known_excess_counts = -c.first,
                  .detuning_sq_first_lambda2 = c.lambda2,
                  .with_phase = c.by_phase};
        (void)step(configured(RelockMethod::frequency), state, tick);
        tick.known_excess_counts = -c.second;
        const RelockDriftOutput out = step(configured(RelockMethod::frequency), state, tick);
        EXPECT_FALSE(out.tick.known || out.first.known);
        EXPECT_NEAR(std::sqrt(out.first.variance_arcsec2), scale * c.claimed_first, 1e-9) << c.first;
        EXPECT_NEAR(std::sqrt(out.tick.variance_arcsec2), scale * c.claimed_second, 1e-9) << c.second;
    }
}

TEST(RelockDriftLaw, NothingIsCorrectedBeforeTheFirstGapOrWithoutAMethod) {
    for (const auto method :
         {RelockMethod::frequency, RelockMethod::detuning, RelockMethod::mean_square, RelockMethod::none}) {
        RelockDriftState state;
        if (method == RelockMethod::none) enter_gap(state);
        for (int k = 0; k < 30; ++k) {
            const RelockDriftOutput out = step(configured(method), state, tick_of(1000.0));
            EXPECT_FALSE(out.due || out.waiting || out.first_due || out.tick.known || out.first.known);
        }
    }
}

TEST(RelockDriftLaw, ExactlyTheTicksAskedForAreDue) {
    for (const auto method : all_methods)
        for (const std::int64_t ticks : {0, 1, 2, 3, 20}) {
            RelockDriftState state;
            for (int gap = 0; gap < 3; ++gap) {  // every gap starts anew, whatever was left of the last
                for (int k = 0; k < 3; ++k) enter_gap(state);
                for (int i = 1; i <= (gap == 1 ? 2 : 25); ++i)
                    EXPECT_EQ(step(configured(method, ticks), state, tick_of(4000.0 / i)).due, i <= ticks)
                        << ticks << ' ' << i;
            }
        }
}

TEST(RelockDriftLaw, TickOneOfFrequencyIsKnownOneTickLater) {
    for (const std::int64_t ticks : {1, 2, 20}) {
        RelockDriftState state{.armed = true};
        const RelockDriftOutput first = step(configured(RelockMethod::frequency, ticks), state, tick_of(4000.0));
        EXPECT_TRUE(first.due && first.waiting && !first.tick.known && !first.first_due);
        const RelockDriftOutput second = step(configured(RelockMethod::frequency, ticks), state, tick_of(1600.0));
        EXPECT_TRUE(second.first_due && second.first.known && !second.waiting);
        EXPECT_EQ(second.due, ticks >= 2);
        EXPECT_EQ(second.tick.known, ticks >= 2);
        // q = sqrt(1600/4000); false rate = deficit (1 - q)/(1 + q) below zero.
        const double q = std::sqrt(0.4);
        EXPECT_NEAR(second.first.value_arcsec, -3.263 * 0.005 * 4000.0 * (1.0 - q) / (1.0 + q), 1e-11);
        const RelockDriftOutput third = step(configured(RelockMethod::frequency, ticks), state, tick_of(640.0));
        EXPECT_FALSE(third.first_due || third.waiting);
    }
}

TEST(RelockDriftLaw, TheRootOfTickIIsOfDegreeTwiceIMinusOne) {
    RelockDriftState state{.armed = true};
    double deficit_hz = 12800.0;  // always a whole number of counts
    for (int i = 1; i <= 4; ++i, deficit_hz *= 0.5) {
        const RelockDriftOutput out = step(configured(RelockMethod::frequency), state, tick_of(deficit_hz));
        if (i == 1) continue;
        const double q = std::pow(0.5, (i - 1.0) / (2.0 * (i - 1.0)));
        EXPECT_NEAR(out.tick.value_arcsec, -3.263 * 0.005 * deficit_hz * (1.0 - q) / (1.0 + q), 1e-11) << i;
    }
}

TEST(RelockDriftLaw, FrequencyNeedsADeficitThatShrinksAndKeepsItsSign) {
    for (const auto& [first_hz, second_hz] :
         {std::pair{0.0, 0.0}, {4000.0, 4000.0}, {4000.0, 4400.0}, {4000.0, 0.0}, {4000.0, -400.0}, {0.0, 400.0}}) {
        RelockDriftState state{.armed = true};
        (void)step(configured(RelockMethod::frequency), state, tick_of(first_hz));
        const RelockDriftOutput out = step(configured(RelockMethod::frequency), state, tick_of(second_hz));
        EXPECT_TRUE(out.due && out.first_due);
        EXPECT_FALSE(out.tick.known || out.first.known) << first_hz << ' ' << second_hz;
        EXPECT_EQ(out.first.value_arcsec, 0.0);
    }
}

TEST(RelockDriftLaw, DetuningNeedsARatioBetweenZeroAndOneAndMeanSquareTwoSquares) {
    const auto means = [](double first, double second) {
        expect_unknown(RelockMethod::detuning, {.detuning_first_lambda = first, .detuning_second_lambda = second});
    };
    const auto squares = [](double first, double second) {
        expect_unknown(RelockMethod::mean_square,
                       {.detuning_sq_first_lambda2 = first, .detuning_sq_second_lambda2 = second});
    };
    for (const double bad : {not_a_number, infinite})
        for (const auto& [first, second] : {std::pair{bad, 0.1}, {0.1, bad}, {bad, bad}}) {
            means(first, second);
            squares(first, second);
        }
    for (const double second : {0.0, 0.1, 0.11, -0.08}) means(0.1, second);
    for (const double first : {0.0, -0.1}) means(first, 0.08);
    // A thousand wavelengths are too many.
    for (const auto& [first, second] : {std::pair{0.0, 0.0}, {1e308, 1e307}, {1000.0, 500.0}, {-1000.0, -500.0}})
        means(first, second);
    for (const auto& [first, second] :
         {std::pair{0.0, 0.0}, {-0.01, 0.02}, {0.02, -0.01}, {1e308, 0.0}, {4e5, 6e5}, {6e5, 5e5}})
        squares(first, second);
}

TEST(RelockDriftLaw, LessThanAThousandWavelengthsMayBeCorrected) {
    RelockDriftState state{.armed = true};
    const Tick squares{.detuning_sq_first_lambda2 = 4e5, .detuning_sq_second_lambda2 = 5.99999e5};
    EXPECT_TRUE(step(configured(RelockMethod::mean_square), state, squares).tick.known);
    const Tick means{.detuning_first_lambda = -999.999, .detuning_second_lambda = -500.0};
    EXPECT_TRUE(step(configured(RelockMethod::detuning), state, means).tick.known);
}

// (chi f0/2) K T = 1e30 arcsec for each square of a wavelength: finite, and it drowns every other number.
TEST(RelockDriftLaw, AFalseAngleBeyondBeliefIsNotUsed) {
    Configured config = configured(RelockMethod::mean_square);
    config.gyro.tick = Seconds{1e9};
    config.gyro.scale = Arcsec{1e9};
    config.gyro.chi = 2.0;
    config.gyro.bias = Hertz{1e12};
    config.gyro.light_noise = Wavelengths{0.0};  // so that a first half of 0 is one that was read
    ASSERT_EQ(check(config.gyro), GyroCompensationFault::none);
    for (const int sign : {1, -1})
        for (const double lambda2 : {1.0 - 0x1p-41, 1.0 + 0x1p-40}) {
            RelockDriftState state{.armed = true};
            EXPECT_EQ(step(config, state, {.sign = sign, .detuning_sq_second_lambda2 = lambda2}).tick.known,
                      lambda2 < 1.0);
        }
}

}  // namespace zlg::core::relock_drift_support::drift_law_test
