#include <zlg/calibration/lab_log.hpp>

#include "test.hpp"

using namespace zlg::calibration;

TEST(LabLog, moments_of_two_halves_are_those_of_the_whole) {
    Moments all;
    Moments first;
    Moments second;
    for (const double x : {3.0, -1.0, 4.0, 1.0, 5.0, -9.0}) {
        all.add(x);
        (x > 0.0 ? first : second).add(x);
    }
    first.add(second);
    first.add(Moments{});
    EXPECT_EQ(first.n, 6);
    EXPECT_NEAR(first.mean, 0.5, 1e-15);
    EXPECT_NEAR(first.variance(), 26.3, 1e-12);
    EXPECT_NEAR(all.variance(), 26.3, 1e-12);
}

TEST(LabLog, the_slope_of_a_voltage_is_that_between_windows_which_do_not_overlap) {
    Segment segment;
    segment.at_start = {.voltage_v = 100.0, .middle_ticks = 50.0, .n = 40};
    segment.at_end = {.voltage_v = 103.0, .middle_ticks = 350.0, .n = 40};
    EXPECT_DOUBLE_EQ(slope_v_per_tick(segment), 0.01);
    segment.at_end.middle_ticks = 60.0;
    EXPECT_EQ(slope_v_per_tick(segment), 0.0);
    segment.at_start.n = 0;
    EXPECT_EQ(slope_v_per_tick(segment), 0.0);
}

TEST(LabLog, a_relock_is_whole_with_a_number_in_each_of_its_halves) {
    Relock relock{.halves = std::vector<zlg::core::HalfRecord>(relock_halves)};
    EXPECT_TRUE(is_whole(relock, &zlg::core::HalfRecord::detuning_lambda));
    relock.halves[7].detuning_lambda = std::nan("");
    EXPECT_FALSE(is_whole(relock, &zlg::core::HalfRecord::detuning_lambda));
    EXPECT_TRUE(is_whole(relock, &zlg::core::HalfRecord::detuning_sq_lambda2));
    relock.halves.pop_back();
    EXPECT_FALSE(is_whole(relock, &zlg::core::HalfRecord::detuning_sq_lambda2));
}
