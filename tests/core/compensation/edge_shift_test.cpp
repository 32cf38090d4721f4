#include <zlg/core/compensation/edge_shift.hpp>

#include "compensation_support.hpp"

namespace zlg::core::edge_shift_test {

using namespace compensation_test;

const CompensationConstants config;
constexpr std::int64_t tick_ticks = 50000;

struct EdgeShiftInput {
    std::int64_t counts = 0;  // of both halves
    int sign_first = 1;
    int sign_second = -1;
    std::int32_t offset_middle_ticks = 0, offset_end_ticks = 0;
    Hertz bias{60e3};
};

EdgeShiftOutput step(CompensationConstants gyro, EdgeShiftState& state, const EdgeShiftInput& in) {
    gyro.bias = in.bias;
    const HalfRecord first{.counts = in.counts,
                           .temperature_c = not_a_number,
                           .mode = static_cast<std::int8_t>(in.sign_first),
                           .edge_offset_ticks = in.offset_middle_ticks};
    const HalfRecord second{.mode = static_cast<std::int8_t>(in.sign_second), .edge_offset_ticks = in.offset_end_ticks};
    return step(gyro, state, first, second, 0);
}

TEST(EdgeShift, AnEdgeCannotMoveByAQuarterOfATick) {
    EXPECT_TRUE(is_possible(config, 12499) && is_possible(config, -12499));
    EXPECT_FALSE(is_possible(config, 12500) || is_possible(config, -12500));
    const CompensationConstants slow{.tick = Seconds{0.005}, .timer = Hertz{1.0}};
    EXPECT_TRUE(is_possible(slow, 0));
    EXPECT_FALSE(is_possible(slow, 1));
}

TEST(EdgeShift, WithoutShiftsTheAngleIsThatOfTheCountsToTheBit) {
    EdgeShiftState s;
    Random random{1};
    for (int k = 0; k < 1000; ++k) {
        const std::int64_t counts = random.integer(-(std::int64_t{1} << 53), std::int64_t{1} << 53);
        const EdgeShiftOutput out = step(config, s, {.counts = counts, .bias = Hertz{random.uniform(1e3, 1e6)}});
        EXPECT_EQ(out.value_arcsec, 3.263 * static_cast<double>(counts));
        EXPECT_EQ(out.known_excess_counts, 0.0);
        EXPECT_EQ(s.residual_arcsec, ExactSum{});
    }
}

// A gyro of whole numbers: `bias` and `rate` are counts per tick of the timer, so that no count is rounded at any edge.
struct WholeGyro {
    std::int64_t bias = 2;
    std::int64_t rate = 0;
    int first_sign = 1;
    int mode = 1;
    std::int32_t start = 0;

    EdgeShiftInput tick(std::int32_t middle, std::int32_t end) {
        const std::int64_t first = tick_ticks / 2 + middle - start, second = tick_ticks / 2 + end - middle;
        start = end;
        const int sign = first_sign * mode;
        return {.counts = sign * bias * (first - second) + rate * (first + second),
                .sign_first = sign,
                .sign_second = -sign,
                .offset_middle_ticks = middle,
                .offset_end_ticks = end,
                .bias = Hertz{static_cast<double>(bias) * config.timer.value()}};
    }
};

// The plateau fills the difference in length, not the mean over a half with its edges.
TEST(EdgeShift, TheAreaIsThatOfThePlateau) {
    CompensationConstants edged = config;
    edged.plateau_ratio = 1.25;
    EdgeShiftState s;
    EXPECT_EQ(step(edged, s, {.counts = 5, .offset_middle_ticks = 20, .bias = Hertz{1e6}}).value_arcsec, 0.0);
}

TEST(EdgeShift, AConstantRateIsTheSameInEveryTickWhateverTheEdgesDo) {
    CompensationConstants fine = config;
    fine.scale = Arcsec{3.263e-3};
    for (const WholeGyro& start : {WholeGyro{.rate = -7}, WholeGyro{.rate = 1}, WholeGyro{.rate = 3}, WholeGyro{},
                                   WholeGyro{.first_sign = -1}, WholeGyro{.mode = -1}}) {
        const std::int64_t rate = start.rate;
        WholeGyro gyro = start;
        EdgeShiftState s;
        Random random{3};
        Quad sum = 0;
        for (int k = 1; k <= 100000; ++k) {
            const double got = step(fine, s, gyro.tick(random.index(-200, 200), random.index(-200, 200))).value_arcsec;
            sum += got;
            ASSERT_NEAR(got, 3.263e-3 * static_cast<double>(rate * tick_ticks), 1e-9);
            const Quad expected = Quad{3.263e-3} * static_cast<Quad>(rate * tick_ticks) * k;
            ASSERT_LT(static_cast<double>(magnitude(sum - expected)), 1e-9);
        }
    }
}

// What one tick gives away the next one gets, whatever was counted: the sum is that of the counts less the area, but
// for what lies beyond the last even end.
TEST(EdgeShift, TheSumLosesNothing) {
    EdgeShiftState s;
    Random random{4};
    Quad sum = 0, counted = 0;
    std::int64_t excess = 0;
    std::int32_t start = 0;
    for (int k = 0; k < 300000; ++k) {
        EdgeShiftInput in{.counts = random.integer(-100000, 100000), .bias = Hertz{60e3}};
        in.offset_middle_ticks = random.index(-170, 170);
        in.offset_end_ticks = random.index(-170, 170);
        in.sign_first = random.chance(0.5) ? 1 : -1;
        in.sign_second = random.chance(0.5) ? 1 : -1;
        excess += in.sign_first * (in.offset_middle_ticks - start) +
                  in.sign_second * (in.offset_end_ticks - in.offset_middle_ticks);
        start = in.offset_end_ticks;
        counted += in.counts;
        sum += step(config, s, in).value_arcsec;
    }
    const Quad expected = Quad{3.263} * (counted - Quad{60e3} / Quad{1e7} * excess) - s.beyond_arcsec;
    EXPECT_LT(static_cast<double>(magnitude(sum - expected)), 1e-7);  // scale * counts is rounded in every tick
}

// Counts of a rate that grows steadily, from the latches' own times. Taken as even, a tick would be wrong by rate times
// shift: half of all it counts per second times 17 us.
TEST(EdgeShift, ASteadyAccelerationIsBroughtBackToEvenTime) {
    constexpr double counts_s2 = 1e12;
    const auto at = [](double t_s) { return 0.5 * counts_s2 * t_s * t_s; };
    EdgeShiftState s;
    Random random{5};
    std::int32_t start = 0;
    double worst = 0.0, worst_uneven = 0.0;
    for (int k = 0; k < 200; ++k) {
        const std::int32_t end = random.index(-170, 170);
        const auto latch_s = [&](int tick, std::int32_t shift) { return tick * 0.005 + shift * 1e-7; };
        const auto counts = static_cast<std::int64_t>(std::llround(at(latch_s(k + 1, end)) - at(latch_s(k, start))));
        const EdgeShiftInput in{.counts = counts, .offset_end_ticks = end, .bias = Hertz{0.0}};
        start = end;
        const double got = step(config, s, in).value_arcsec;
        const double even = at((k + 1) * 0.005) - at(k * 0.005);
        if (k < 2) continue;  // the first tick has no rate before it
        worst = std::max(worst, std::abs(got / 3.263 - even));
        worst_uneven = std::max(worst_uneven, std::abs(static_cast<double>(counts) - even));
    }
    EXPECT_LT(worst, 2.0 * counts_s2 * 17e-6 * 17e-6 + 2.0);
    EXPECT_GT(worst_uneven, 1e3 * worst);
}

TEST(EdgeShift, AfterAGapATickTakesItsOwnRate) {
    WholeGyro gyro{.rate = 5};
    EdgeShiftState s;
    (void)step(config, s, gyro.tick(10, 100));
    break_off(s);
    EXPECT_EQ(s.offset_ticks, 100);
    EXPECT_NEAR(step(config, s, gyro.tick(-30, -70)).value_arcsec, 3.263 * 5 * 50000, 1e-9);
}

// Without rotation the halves differ by the bias's own counts, twice 5e4, and by what they differ in length.
TEST(EdgeShift, SaysWhatTheShiftsAddToTheDifferenceOfTheHalves) {
    for (const int rate : {0, 3}) {
        WholeGyro gyro{.rate = rate};
        EdgeShiftState s;
        EXPECT_NEAR(step(config, s, gyro.tick(40, -60)).known_excess_counts, -120.0 + 140.0 * rate, 1e-9);
        // first: from -60 to 10, second: from 10 to 0
        EXPECT_NEAR(step(config, s, gyro.tick(10, 0)).known_excess_counts, 120.0 + 80.0 * rate, 1e-9);
    }
}

// A tick that the edges leave no time has no rate; what it overflows is forgotten, and the next ones are corrected
// again.
TEST(EdgeShift, ANumberThatOverflowsSpoilsNoLaterTick) {
    EdgeShiftState s;
    EXPECT_EQ(step(config, s, {.counts = 7, .offset_end_ticks = -50000}).value_arcsec, 3.263 * 7);
    (void)step(config, s, {});
    (void)step(config, s, {});
    WholeGyro gyro;
    Random random{7};
    for (int k = 0; k < 100; ++k) {
        const EdgeShiftInput in = gyro.tick(random.index(-12499, 12499), random.index(-12499, 12499));
        EXPECT_NEAR(step(config, s, in).value_arcsec, 0.0, 1e-9);
    }
}

TEST(EdgeShift, NothingThatComesOutIsNotANumber) {
    Random random{6};
    for (int k = 0; k < 2000; ++k) {
        const double any[] = {infinite, -infinite, not_a_number, 1e300, 1e15, 60e3, -1.0, 0.0};
        const double sizes[] = {1e-9, 1e-6, 0.005, 10.0, 1e9};
        const CompensationConstants wild{.tick = Seconds{sizes[random.index(0, 4)]},
                                         .scale = Arcsec{random.chance(0.5) ? 3.263 : 1e9},
                                         .timer = Hertz{random.chance(0.5) ? 1.0 : 1e15},
                                         .plateau_ratio = 2.0};
        ASSERT_EQ(check(wild), GyroCompensationFault::none);
        EdgeShiftState s;
        for (int tick = 0; tick < 10; ++tick) {
            EdgeShiftInput in{.counts = random.integer(-(std::int64_t{1} << 53), std::int64_t{1} << 53)};
            in.bias = Hertz{any[random.index(0, 7)]};
            const auto shift = static_cast<std::int32_t>(random.integer(INT32_MIN, INT32_MAX));
            if (is_possible(wild, shift)) in.offset_middle_ticks = in.offset_end_ticks = shift;
            const EdgeShiftOutput out = step(wild, s, in);
            ASSERT_TRUE(std::isfinite(out.value_arcsec) && std::isfinite(out.known_excess_counts));
        }
    }
}

}  // namespace zlg::core::edge_shift_test
