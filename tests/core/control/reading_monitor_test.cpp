#include <zlg/core/control/reading_monitor.hpp>

#include "support.hpp"

namespace zlg::core::reading_monitor_test {

constexpr std::int64_t bias = 150;
constexpr std::int64_t limit = 1253;

struct Half {
    std::int64_t turned = 0;  // counts of the rotation
    std::int64_t off = 0;     // of the reading at its end
    bool read = true;
    bool countable = true;
    std::int8_t mode = 1;
};

// A gyro of 150 counts of bias a half, with the band that the bias monitor has: 25 counts and what the rotation has
// changed.
using Angle = std::pair<std::int64_t, std::int64_t>;  // halves that the trusted counts go over, and their sum

struct Readout {
    std::vector<ReadingMonitorOutput> out;
    Angle angle{0, 0};
};

Readout run(const std::vector<Half>& halves) {
    ReadingMonitorState state;
    Readout all;
    std::uint64_t counter = 0, last = 0;
    std::int64_t step_before = 0;
    bool known = true;
    for (std::size_t h = 0; h < halves.size(); ++h) {
        const std::int8_t sign = h % 2 == 0 ? 1 : -1;
        counter += static_cast<std::uint64_t>(halves[h].turned + sign * bias);
        const std::uint64_t reading = counter + static_cast<std::uint64_t>(halves[h].off);
        const auto step_now = static_cast<std::int64_t>(reading - last);
        const double b = 0.5 * sign * static_cast<double>(step_now - step_before);
        const bool off = h > 0 && known && (b > bias + 13 || b < bias - 13);
        const bool beyond = step_now > limit || step_now < -limit;
        all.out.push_back(step(state, {.read = halves[h].read,
                                       .countable = halves[h].countable,
                                       .mode = halves[h].mode,
                                       .suspicious = off || beyond,
                                       .agrees = halves[h].read && known && !off && !beyond,
                                       .reading = reading,
                                       .max_counts = static_cast<double>(limit),
                                       .bias_counts = bias,
                                       .beat_sign = sign}));
        if (all.out.back().trusted) {
            all.angle.first += all.out.back().span;
            all.angle.second += all.out.back().counts;
        }
        known = halves[h].read;
        if (known) {
            step_before = step_now;
            last = reading;
        }
    }
    return all;
}

std::vector<Half> turning(std::size_t n, std::int64_t counts) { return std::vector<Half>(n, Half{.turned = counts}); }

TEST(ReadingMonitor, HalvesThatAreReadHaveTheirOwnCounts) {
    const Readout all = run(turning(20, 3));
    for (std::size_t h = 0; h < 20; ++h) {
        EXPECT_TRUE(all.out[h].trusted);
        EXPECT_EQ(all.out[h].span, 1);
        EXPECT_EQ(all.out[h].counts, 3 + (h % 2 == 0 ? bias : -bias));
    }
}

TEST(ReadingMonitor, TheHalfAfterMissedOnesHasTheWholeDifference) {
    for (const std::size_t n : {1u, 2u, 7u, 400u, 24000u}) {
        auto halves = turning(n + 40, 3);
        for (std::size_t h = 20; h < 20 + n; ++h) halves[h].read = false;
        const Readout all = run(halves);
        EXPECT_EQ(all.out[20 + n].span, static_cast<std::int32_t>(n) + 1);
        const auto total = static_cast<std::int64_t>(halves.size());
        EXPECT_EQ(all.angle, (Angle{total, 3 * total + (total % 2 != 0 ? bias : 0)}));
    }
}

TEST(ReadingMonitor, AWrongReadingComesBackAndTakesNothing) {
    for (const std::int64_t off : {30, -64, 100, -150, 256, 1000, -300, 1200, 100'000}) {
        for (std::size_t n = 1; n <= 3; ++n) {
            auto halves = turning(60, 3);
            for (std::size_t h = 20; h < 20 + n; ++h) halves[h].off = off;
            const Readout all = run(halves);
            EXPECT_FALSE(all.out[20].trusted) << off << " " << n;
            EXPECT_EQ(all.angle, (Angle{60, 180})) << off << " " << n;
            EXPECT_TRUE(all.out[26].trusted) << off << " " << n;
        }
    }
}

// A gyro half by half: a rate of 3 counts, a reading that is 400 off, more that are missed or lack the bias, and one
// that is `off` from where the rate leads to.
ReadingMonitorOutput after_a_wrong_reading(int more, std::int64_t off, bool bias_lost = false) {
    ReadingMonitorState state;
    ReadingMonitorInput in{.read = true, .countable = true, .mode = 1, .max_counts = limit, .bias_counts = bias};
    std::int64_t counter = 0;
    std::int8_t sign = -1;
    const auto half = [&](std::int64_t turned, std::int64_t wrong) {
        sign = static_cast<std::int8_t>(-sign);
        counter += turned + sign * bias;
        in.reading = static_cast<std::uint64_t>(counter + wrong);
        in.beat_sign = sign;
        return step(state, in);
    };
    in.agrees = true;
    for (int h = 0; h < 6; ++h) EXPECT_TRUE(half(3, 0).trusted);
    in.suspicious = true;
    in.agrees = false;
    EXPECT_FALSE(half(3, 400).trusted);
    in.suspicious = false;
    in.bias_lost = bias_lost;
    in.read = bias_lost;
    for (int h = 0; h < more; ++h) EXPECT_FALSE(half(3, 400).trusted) << h;
    in.read = true;
    in.agrees = !bias_lost;
    return half(3, off);
}

// Within a sixth of the bias, 25 counts, where the rate stood still; the bias of an odd number of halves is part of the
// way.
TEST(ReadingMonitor, AReadingHasReturnedWhereTheRateAndTheBiasLeadTo) {
    for (const int missed : {0, 1, 2}) {
        for (const int side : {1, -1}) {
            const ReadingMonitorOutput back = after_a_wrong_reading(missed, side * 24);
            EXPECT_TRUE(back.trusted) << missed;
            EXPECT_EQ(back.span, missed + 2);
            EXPECT_FALSE(after_a_wrong_reading(missed, side * 27).trusted) << missed;
        }
    }
}

// Without its bias for 16 halves the gyro was not in its mode: its counts begin anew.
TEST(ReadingMonitor, ABiasThatStaysLostEndsTheWait) {
    EXPECT_FALSE(after_a_wrong_reading(14, 400, true).trusted);
    const ReadingMonitorOutput anew = after_a_wrong_reading(15, 400, true);
    EXPECT_TRUE(anew.trusted);
    EXPECT_EQ(anew.span, 1);
}

TEST(ReadingMonitor, ARotationThatTheNextReadingsConfirmIsKept) {
    for (const std::int64_t turned : {30, -47, 92, 138, -151, 300, 777, -999}) {
        for (std::size_t n = 1; n <= 3; ++n) {
            auto halves = turning(60, 3);
            for (std::size_t h = 20; h < 20 + n; ++h) halves[h].turned = turned / static_cast<std::int64_t>(h - 19);
            std::int64_t sum = 0;
            for (const Half& half : halves) sum += half.turned;
            const Readout all = run(halves);
            EXPECT_EQ(all.angle, (Angle{60, sum})) << turned << " " << n;
        }
    }
}

// A vibration that is out of the bias's band again and again: the readings never agree four times in a row.
TEST(ReadingMonitor, ASuspicionThatNothingSettlesEnds) {
    auto halves = turning(4000, 0);
    for (std::size_t h = 100; h < 3900; ++h)
        halves[h].turned =
            std::llround(120.0 * std::sin(2.0 * 3.14159265358979 * 60.0 * 0.0025 * static_cast<double>(h)));
    std::int64_t sum = 0;
    for (const Half& half : halves) sum += half.turned;
    const Readout all = run(halves);
    EXPECT_EQ(all.angle, (Angle{4000, sum}));
    std::int32_t longest = 0;
    for (const ReadingMonitorOutput& out : all.out) longest = std::max(longest, out.span);
    EXPECT_LE(longest, 45);
    EXPECT_GT(longest, 4);
}

// An error that stays is taken for a rotation, and so is the step back: in the end nothing is left of it.
TEST(ReadingMonitor, AnErrorOfManyReadingsLeavesTheAngleWhenItEnds) {
    for (const std::int64_t off : {-40, 128, 512, 1024}) {
        for (std::size_t n = 4; n < 40; ++n) {
            auto halves = turning(100, 20);
            for (std::size_t h = 20; h < 20 + n; ++h) halves[h].off = off;
            const Readout all = run(halves);
            EXPECT_EQ(all.angle, (Angle{100, 2000})) << off << " " << n;
        }
    }
}

TEST(ReadingMonitor, AStepThatNoGyroTurnsIsNotAdded) {
    for (const std::int64_t off : {9000, -1'000'000}) {
        auto halves = turning(100, 3);
        for (std::size_t h = 20; h < 100; ++h) halves[h].off = off;
        const Readout all = run(halves);
        EXPECT_EQ(all.angle, (Angle{95, 3 * 95 - bias})) << off;
    }
}

TEST(ReadingMonitor, CountsAtTheStopOfTheCounterAreNoAngle) {
    auto halves = turning(100, 0);
    for (std::size_t h = 20; h < 24; ++h) halves[h].turned = 1260 - (h % 2 == 0 ? bias : -bias);
    const Readout all = run(halves);
    for (std::size_t h = 0; h < 100; ++h) EXPECT_EQ(all.out[h].trusted, h < 20 || h >= 20 + 36) << h;
    EXPECT_EQ(all.angle.second, 0);
}

// A switch while it lasts, or soon after, does not end the hold.
TEST(ReadingMonitor, CountsAtTheStopBeforeASwitchAreNoAngleEither) {
    for (std::size_t opens = 21; opens < 54; ++opens) {
        auto halves = turning(100, 0);
        for (std::size_t h = 20; h < 24; ++h) halves[h].turned = 1260 - (h % 2 == 0 ? bias : -bias);
        for (std::size_t h = opens; h < 100; ++h) {
            halves[h].mode = -1;
            halves[h].countable = h >= opens + 6;
        }
        const Readout all = run(halves);
        for (std::size_t h = 20; h < 20 + 36; ++h) EXPECT_FALSE(all.out[h].trusted) << opens << " " << h;
        for (std::size_t h = 20 + 37 + 6; h < 100; ++h) EXPECT_TRUE(all.out[h].trusted) << opens << " " << h;
        EXPECT_EQ(all.angle.second, 0) << opens;
    }
}

TEST(ReadingMonitor, OfAnOpenLoopOrAnotherModeNothingIsTakenAcross) {
    for (const bool opens : {true, false}) {
        auto halves = turning(60, 3);
        for (std::size_t h = 20; h < 30; ++h) halves[h].read = false;
        for (std::size_t h = 24; h < 27 && opens; ++h) halves[h].countable = false;
        for (std::size_t h = 26; h < 60 && !opens; ++h) halves[h].mode = -1;
        const Readout all = run(halves);
        EXPECT_FALSE(all.out[30].trusted);
        EXPECT_EQ(all.out[31].span, 1);
        EXPECT_EQ(all.angle.first, 60 - 11);
    }
}

// The reading before the first half of a closed loop is as good as any: what turns in that half is not lost.
TEST(ReadingMonitor, AJerkInTheFirstHalfAfterAnOpenLoopIsKept) {
    std::vector<Half> halves(40);
    for (std::size_t h = 10; h < 16; ++h) halves[h].countable = false;
    halves[16].turned = -200;
    halves[17].turned = -190;
    const Readout all = run(halves);
    EXPECT_FALSE(all.out[16].trusted);
    EXPECT_EQ(all.angle, (Angle{40, -390}));
}

TEST(ReadingMonitor, NumbersBegunAnewBeginAnew) {
    ReadingMonitorState state;
    ReadingMonitorInput in{.read = true, .countable = true, .reading = 5000, .max_counts = static_cast<double>(limit)};
    in.follows = false;
    EXPECT_FALSE(step(state, in).trusted);
    in.follows = true;
    in.reading = 5010;
    const ReadingMonitorOutput next = step(state, in);
    EXPECT_TRUE(next.trusted);
    EXPECT_EQ(next.counts, 10);
}

}  // namespace zlg::core::reading_monitor_test
