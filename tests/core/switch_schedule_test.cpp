#include <gtest/gtest.h>

#include <limits>
#include <vector>
#include <zlg/core/switch_schedule.hpp>

namespace zlg::core {
namespace {

static_assert(check(SwitchScheduleConfig{}) == SwitchScheduleFault::none);
static_assert(check(SwitchScheduleConfig{.interval_ticks = 0}) == SwitchScheduleFault::interval);
static_assert(check(SwitchScheduleConfig{.interval_ticks = -5}) == SwitchScheduleFault::interval);
static_assert(check(SwitchScheduleConfig{.interval_ticks = std::numeric_limits<std::int64_t>::max()}) ==
              SwitchScheduleFault::interval);

// Ticks at which the loop opens, when the gyro is ready at all ticks but those of [busy_from, busy_to).
std::vector<std::int64_t> openings(const SwitchScheduleConfig& c, std::int64_t n_ticks, std::int64_t busy_from = 0,
                                   std::int64_t busy_to = 0) {
    SwitchScheduleState s = initial_state(c);
    std::vector<std::int64_t> result;
    for (std::int64_t tick = 1; tick < n_ticks; ++tick) {
        if (step(c, s, tick, !(tick >= busy_from && tick < busy_to)).open) result.push_back(tick);
    }
    return result;
}

TEST(SwitchSchedule, OpensOnTheGridFromAFullFirstSegment) {
    EXPECT_EQ(openings({.interval_ticks = 7}, 30), (std::vector<std::int64_t>{7, 14, 21, 28}));
}

TEST(SwitchSchedule, AHalfFirstSegmentIsRoundedDownToTicks) {
    EXPECT_EQ(openings({.interval_ticks = 7, .first_segment = FirstSegment::half}, 25),
              (std::vector<std::int64_t>{3, 10, 17, 24}));
}

TEST(SwitchSchedule, AnOpeningThatHadToWaitDoesNotMoveTheGrid) {
    EXPECT_EQ(openings({.interval_ticks = 10}, 41, 18, 23), (std::vector<std::int64_t>{10, 23, 30, 40}));
}

TEST(SwitchSchedule, SeveralThatWaitAreOne) {
    EXPECT_EQ(openings({.interval_ticks = 10}, 51, 18, 43), (std::vector<std::int64_t>{10, 43, 50}));
}

TEST(SwitchSchedule, ALateOpeningIsSaidToBeLate) {
    const SwitchScheduleConfig c{.interval_ticks = 10};
    SwitchScheduleState s = initial_state(c);
    EXPECT_FALSE(step(c, s, 10, false).open);
    const SwitchScheduleOutput late = step(c, s, 11, true);
    EXPECT_TRUE(late.open);
    EXPECT_TRUE(late.late);
    const SwitchScheduleOutput in_time = step(c, s, 20, true);
    EXPECT_TRUE(in_time.open);
    EXPECT_FALSE(in_time.late);
}

TEST(SwitchSchedule, AJumpOverIntervalsOpensOnceAndLaysTheGridAnew) {
    const SwitchScheduleConfig c{.interval_ticks = 10};
    SwitchScheduleState s = initial_state(c);
    EXPECT_TRUE(step(c, s, 1003, true).open);
    for (std::int64_t tick = 1004; tick < 1013; ++tick) EXPECT_FALSE(step(c, s, tick, true).open);
    EXPECT_TRUE(step(c, s, 1013, true).open);
}

TEST(SwitchSchedule, AnyTickNumberIsSurvived) {
    using Limits = std::numeric_limits<std::int64_t>;
    for (const std::int64_t interval : {std::int64_t{1}, std::int64_t{1} << 53}) {
        const SwitchScheduleConfig c{.interval_ticks = interval};
        SwitchScheduleState s = initial_state(c);
        EXPECT_FALSE(step(c, s, Limits::min(), true).open);
        EXPECT_FALSE(step(c, s, Limits::max(), true).open);
        EXPECT_TRUE(step(c, s, (std::int64_t{1} << 62) - 1, true).open);
        EXPECT_FALSE(step(c, s, 0, true).open);
    }
}

}  // namespace
}  // namespace zlg::core
