#include <zlg/firmware/pulse.hpp>

#include "test.hpp"

namespace zlg::pulse_test {

using firmware::Pulse;
using firmware::time_of;

TEST(Pulse, a_tick_is_stamped_by_the_last_one) {
    const wire::TickTime expected{.timer_ticks = 1'234, .synchronised = true, .n_pulses = 7, .since_pulse_ticks = 234};
    EXPECT_EQ(time_of(1'234, Pulse{.n = 7, .stamp_ticks = 1'000}), expected);
}

TEST(Pulse, the_timer_may_wrap_between_pulse_and_tick) {
    EXPECT_EQ(time_of(5, Pulse{.n = 1, .stamp_ticks = UINT64_MAX - 4}).since_pulse_ticks, 10u);
}

TEST(Pulse, without_one_or_with_one_that_is_later_or_long_past_there_is_the_timer_alone) {
    const wire::TickTime alone{.timer_ticks = 1'000};
    EXPECT_EQ(time_of(1'000, Pulse{}), alone);
    EXPECT_EQ(time_of(1'000, Pulse{.n = 3, .stamp_ticks = 1'001}), alone);
    const std::uint64_t late = 1'000 + (std::uint64_t{1} << 32);
    EXPECT_EQ(time_of(late, Pulse{.n = 3, .stamp_ticks = 1'000}), wire::TickTime{.timer_ticks = late});
    EXPECT_TRUE(time_of(late - 1, Pulse{.n = 3, .stamp_ticks = 1'000}).synchronised);
}

}  // namespace zlg::pulse_test
