#include <gtest/gtest.h>

#include <limits>
#include <vector>
#include <zlg/core/switch_schedule.hpp>

namespace zlg::core {
namespace {

static_assert(check(SwitchScheduleConfig{}) == SwitchScheduleFault::none);
static_assert(check(SwitchScheduleConfig{.interval_ticks = 1}) == SwitchScheduleFault::interval);
static_assert(check(SwitchScheduleConfig{.interval_ticks = -5}) == SwitchScheduleFault::interval);
static_assert(check(SwitchScheduleConfig{.interval_ticks = std::numeric_limits<std::int64_t>::max()}) ==
              SwitchScheduleFault::interval);

// Ticks at which the loop opens, when the gyro is ready at all ticks but those of [busy_from, busy_to).
std::vector<std::int64_t> openings(const SwitchScheduleConfig& c, std::int64_t n_ticks, std::int64_t busy_from = 0,
                                   std::int64_t busy_to = 0) {
    SwitchScheduleState s;
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
    SwitchScheduleState s;
    const SwitchScheduleConfig c{.interval_ticks = 10};
    EXPECT_FALSE(step(c, s, 10, false).open);
    const SwitchScheduleOutput late = step(c, s, 11, true);
    EXPECT_TRUE(late.open);
    EXPECT_TRUE(late.late);
    const SwitchScheduleOutput in_time = step(c, s, 20, true);
    EXPECT_TRUE(in_time.open);
    EXPECT_FALSE(in_time.late);
}

TEST(SwitchSchedule, AnyTickNumberIsSurvived) {
    constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
    for (const std::int64_t interval : {std::int64_t{2}, std::int64_t{1} << 53}) {
        SwitchScheduleState s;
        const SwitchScheduleConfig c{.interval_ticks = interval};
        EXPECT_FALSE(step(c, s, std::numeric_limits<std::int64_t>::min(), true).open);
        EXPECT_TRUE(step(c, s, most, true).open);
        EXPECT_FALSE(step(c, s, most, true).open);
        EXPECT_FALSE(step(c, s, 0, true).open);
    }
}

}  // namespace
}  // namespace zlg::core
