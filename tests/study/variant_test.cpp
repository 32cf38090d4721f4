#include <gtest/gtest.h>

#include <cmath>

#include <zlg/study/variant.hpp>

namespace {

using namespace zlg::study;

TEST(Drift, is_the_least_squares_slope) {
    Drift line;
    for (int k = 0; k < 1000; ++k) line.add(1e4 + 0.005 * k, 3.0 + 0.25 * 0.005 * k);
    EXPECT_NEAR(line.slope_arcsec_s(), 0.25, 1e-9);

    // Of the points (0,0), (1,1), (2,4): slope 2.
    Drift bent;
    bent.add(0, 0), bent.add(1, 1), bent.add(2, 4);
    EXPECT_NEAR(bent.slope_arcsec_s(), 2.0, 1e-12);
}

TEST(Drift, of_one_point_is_zero) {
    Drift one;
    one.add(5.0, 7.0);
    EXPECT_EQ(one.slope_arcsec_s(), 0.0);
}

TEST(SwitchStatistics, undo_the_alternating_sign_in_the_mean_only) {
    const auto s = statistics({{{.sign_after = 1}, 3.0, 0.0}, {{.sign_after = -1}, -5.0, 0.0}});
    ASSERT_TRUE(s);
    EXPECT_DOUBLE_EQ(s->mean_arcsec, 4.0);
    EXPECT_DOUBLE_EQ(s->rms_arcsec, std::sqrt(17.0));
    EXPECT_DOUBLE_EQ(s->max_arcsec, 5.0);
    EXPECT_FALSE(statistics({}));
}

TEST(ErrorMeter, adds_up_a_window_and_the_whole_run) {
    const SwitchWindow window{.first_tick = 2, .n_ticks = 2, .last_tick = 4};
    ErrorMeter meter{0.5, 2};
    for (int tick = 0; tick < 8; ++tick)
        meter.take({.tick = tick, .dtheta_final_arcsec = 10.0 + tick, .relock_arcsec = 1.0}, 10.0, {window});
    EXPECT_DOUBLE_EQ(meter.angle_error_arcsec(), 28.0);
    ASSERT_EQ(meter.switches().size(), 1u);
    EXPECT_DOUBLE_EQ(meter.switches()[0].error_arcsec, 2.0 + 3.0 + 4.0);
    EXPECT_DOUBLE_EQ(meter.switches()[0].relock_arcsec, 3.0);
    EXPECT_EQ(meter.curve().t_s, (std::vector<double>{1.0, 2.0, 3.0, 4.0}));
    EXPECT_EQ(meter.curve().error_arcsec, (std::vector<double>{1.0, 6.0, 15.0, 28.0}));
}

TEST(ErrorMeter, drops_a_switch_whose_window_is_not_over) {
    const SwitchWindow window{.first_tick = 2, .n_ticks = 2, .last_tick = 40};
    ErrorMeter meter{0.5, 1};
    for (int tick = 0; tick < 8; ++tick) meter.take({.tick = tick}, 1.0, {window});
    EXPECT_TRUE(meter.switches().empty());
}

}  // namespace
