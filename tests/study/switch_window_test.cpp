
#include <zlg/study/switch_window.hpp>

#include "test.hpp"

namespace {

using zlg::core::HalfRecord;
using zlg::study::SwitchFinder;

// One letter a tick: + and - measured in that mode, o open and m missed, both in the mode of the next + or -.
SwitchFinder found(const char* ticks, int relock_ticks, int first_sign = 1) {
    SwitchFinder finder{relock_ticks};
    for (std::int64_t t = 0; ticks[t] != '\0'; ++t) {
        HalfRecord half;
        half.mode = 1;
        for (std::int64_t k = t; ticks[k] != '\0'; ++k) {
            if (ticks[k] != '+' && ticks[k] != '-') continue;
            half.mode = ticks[k] == '+' ? std::int8_t{1} : std::int8_t{-1};
            break;
        }
        half.loop_closed = ticks[t] != 'o';
        half.valid = ticks[t] != 'm';
        half.bias_sign = static_cast<std::int8_t>(first_sign);
        finder.take(t, half, half);
    }
    return finder;
}

TEST(SwitchFinder, a_switch_is_a_gap_across_which_the_helicity_changes) {
    auto finder = found("+++ooo------", 4, -1);
    ASSERT_EQ(finder.windows().size(), 1u);
    const auto& w = finder.windows().front();
    EXPECT_EQ(w.first_tick, 3);
    EXPECT_EQ(w.n_ticks, 3);
    EXPECT_EQ(w.last_tick, 9);
    EXPECT_EQ(w.mode_after, -1);
    EXPECT_EQ(w.sign_after, 1);
}

TEST(SwitchFinder, missed_frames_in_one_mode_are_no_switch) { EXPECT_TRUE(found("+++m+++mm++", 4).windows().empty()); }

TEST(SwitchFinder, a_gap_before_the_first_measured_tick_is_no_switch) {
    EXPECT_TRUE(found("oo-----", 4).windows().empty());
}

TEST(SwitchFinder, the_next_gap_cuts_a_window_short) {
    auto finder = found("++o--o++++", 20);
    ASSERT_EQ(finder.windows().size(), 2u);
    EXPECT_EQ(finder.windows()[0].last_tick, 4);
    EXPECT_EQ(finder.windows()[1].last_tick, 25);
}

}  // namespace
