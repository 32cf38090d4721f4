#include <zlg/design/initial_miss.hpp>

#include <zlg/design/error.hpp>

#include "test.hpp"

namespace zlg::design::initial_miss_test {

double part(const InitialMiss& miss, std::string_view name) {
    for (const MissPart& p : miss.part) {
        if (p.name == name) return p.lambda;
    }
    return std::nan("");
}

TEST(InitialMiss, EachCauseHasItsPart) {
    MissCauses c;
    c.half_wave_error_ratio = 0.05;
    c.dwell_s = 100.0;
    const auto miss = initial_miss(c);
    EXPECT_NEAR(part(miss, "half wave"), 0.025, 1e-15);                         // 2 V of 40 V
    EXPECT_NEAR(part(miss, "DAC step"), 0.5 * 300.0 / 4096.0 * 0.0125, 1e-15);  // half of 0.0009
    EXPECT_NEAR(part(miss, "hysteresis"), 0.12 * 40.0 * (40.0 / 300.0) * 0.0125, 1e-15);
    EXPECT_NEAR(part(miss, "creep"), 4.0 * 0.0075, 1e-15);  // four decades
}

// Play operators of uniform density of thresholds up to S/2, swept over a loop of stroke s: width at its middle.
TEST(InitialMiss, TheWidthOfASmallLoopGoesAsTheSquareOfItsStroke) {
    constexpr int n_plays = 2000;
    const auto width_at = [](double stroke, double full) {
        double up = 0.0, down = 0.0;
        for (int k = 0; k < n_plays; ++k) {
            const double r = 0.5 * full * (k + 0.5) / n_plays;
            const double reach = std::max(0.0, 0.5 * stroke - r);  // a play moves between -reach and reach
            up += std::max(-reach, 0.0 - r);                       // input rising through 0
            down += std::min(reach, 0.0 + r);
        }
        return down - up;
    };
    const double ratio = width_at(40.0, 300.0) / width_at(300.0, 300.0);
    MissCauses full, small;
    full.half_wave_v = full.hysteresis_stroke_v;
    const double volts_full = voltage_of_miss_v(part(initial_miss(full), "hysteresis"), full.half_wave_v);
    const double volts_small = voltage_of_miss_v(part(initial_miss(small), "hysteresis"), small.half_wave_v);
    EXPECT_NEAR(volts_full, 0.12 * 300.0, 1e-12);
    EXPECT_NEAR(volts_small / volts_full, ratio, 1e-3 * ratio);
}

TEST(InitialMiss, TheSumsAreThoseOfTheParts) {
    MissCauses c;
    c.half_wave_error_ratio = 0.1;
    const auto miss = initial_miss(c);
    double square = 0.0, sum = 0.0;
    for (const MissPart& p : miss.part) {
        EXPECT_FALSE(p.name.empty());
        square += p.lambda * p.lambda;
        sum += p.lambda;
    }
    EXPECT_NEAR(miss.root_sum_square_lambda, std::sqrt(square), 1e-15);
    EXPECT_NEAR(miss.worst_lambda, sum, 1e-15);
    EXPECT_LT(miss.root_sum_square_lambda, miss.worst_lambda);
}

// The miss of the first switch of simulated plays with creep, 0.038; 0.066 with an error of 5 %.
TEST(InitialMiss, TheWorstSumAgreesWithSimulatedPiezos) {
    MissCauses c;
    EXPECT_NEAR(initial_miss(c).worst_lambda, 0.038, 0.002);
    c.half_wave_error_ratio = 0.05;
    EXPECT_NEAR(initial_miss(c).worst_lambda, 0.066, 0.004);
    EXPECT_NEAR(part(initial_miss(c), "creep"), 0.030, 0.001);
}

TEST(InitialMiss, TheMissOfTheTablesNeedsAboutEighteenVolts) {
    EXPECT_NEAR(voltage_of_miss_v(0.22, 40.0), 17.6, 1e-12);
}

TEST(InitialMiss, RefusesWhatIsOutOfRange) {
    const auto with = [](auto change) {
        MissCauses c;
        change(c);
        return c;
    };
    EXPECT_THROW((void)initial_miss(with([](auto& c) { c.half_wave_v = 0.0; })), DesignError);
    EXPECT_THROW((void)initial_miss(with([](auto& c) { c.half_wave_error_ratio = std::nan(""); })), DesignError);
    EXPECT_THROW((void)initial_miss(with([](auto& c) { c.dac_bits = 0; })), DesignError);
    EXPECT_THROW((void)initial_miss(with([](auto& c) { c.hysteresis_stroke_v = 39.0; })), DesignError);
    EXPECT_THROW((void)initial_miss(with([](auto& c) { c.dwell_s = 0.001; })), DesignError);
    EXPECT_THROW((void)initial_miss(with([](auto& c) { c.creep_ratio_per_decade = -0.1; })), DesignError);
    EXPECT_THROW((void)voltage_of_miss_v(0.2, 0.0), DesignError);
}

}  // namespace zlg::design::initial_miss_test
