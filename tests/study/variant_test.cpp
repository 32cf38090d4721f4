
#include <zlg/study/variant.hpp>

#include "test.hpp"

namespace zlg::study::variant_test {

const zlg::design::GyroDrift no_drift{0.0, 0.0, 0.0, 3000.0};

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
    ErrorMeter meter{0.5, 2, no_drift};
    for (int tick = 0; tick < 8; ++tick)
        meter.take({.tick = tick, .dtheta_final_arcsec = 10.0 + tick, .relock_arcsec = 1.0}, {10.0, 0.0}, {window});
    EXPECT_DOUBLE_EQ(meter.angle_error_arcsec(), 28.0);
    ASSERT_EQ(meter.switches().size(), 1u);
    EXPECT_DOUBLE_EQ(meter.switches()[0].error_arcsec, 2.0 + 3.0 + 4.0);
    EXPECT_DOUBLE_EQ(meter.switches()[0].relock_arcsec, 3.0);
    EXPECT_EQ(meter.curve().t_s, (std::vector<double>{1.0, 2.0, 3.0, 4.0}));
    EXPECT_EQ(meter.curve().error_arcsec, (std::vector<double>{1.0, 6.0, 15.0, 28.0}));
}

// Drift of 2 and +-4 arcsec/s in ticks of 0.5 s, which a gap of two ticks bridges by its mean: no error. What the
// compensation has taken out of two of them is none either.
TEST(ErrorMeter, the_drift_within_a_window_is_no_error_of_the_switch) {
    const SwitchWindow window{.first_tick = 2, .n_ticks = 2, .last_tick = 7};
    ErrorMeter meter{0.5, 2, design::GyroDrift{2.0, 4.0, 0.0, 3000.0}};
    for (int tick = 0; tick < 8; ++tick) {
        const double mode = tick < 2 ? 1.0 : tick < 4 ? 0.0 : -1.0;
        const double taken_out = tick > 5 ? -1.5 : 0.0;
        const double error = tick == 3 ? 0.25 : 0.0;
        meter.take({.tick = tick,
                    .dtheta_final_arcsec = 100.0 + 0.5 * (2.0 + 4.0 * mode) - taken_out + error,
                    .mode = static_cast<std::int8_t>(tick < 3 ? 1 : -1)},
                   {100.0, taken_out}, {window});
    }
    ASSERT_EQ(meter.switches().size(), 1u);
    EXPECT_NEAR(meter.switches()[0].error_arcsec, 0.25, 1e-12);
}

// A window of ticks 2..4: the rounding after tick 1 stays in the angle, that after tick 4 is given back.
TEST(ErrorMeter, roundings_count_at_the_edges_of_the_gap) {
    const SwitchWindow window{.first_tick = 2, .n_ticks = 2, .last_tick = 4};
    ErrorMeter meter{0.5, 2, design::GyroDrift{0.0, 0.0, 0.0, 3000.0}};
    for (int tick = 0; tick < 8; ++tick)
        meter.take({.tick = tick, .dtheta_final_arcsec = 11.0},
                   {.rotation_arcsec = 10.0, .rounding_arcsec = -0.1 * (tick + 1)}, {window});
    ASSERT_EQ(meter.switches().size(), 1u);
    EXPECT_NEAR(meter.switches()[0].error_arcsec, 3.0 - 0.2 + 0.5, 1e-12);
}

TEST(ErrorMeter, drops_a_switch_whose_window_is_not_over) {
    const SwitchWindow window{.first_tick = 2, .n_ticks = 2, .last_tick = 40};
    ErrorMeter meter{0.5, 1, no_drift};
    for (int tick = 0; tick < 8; ++tick) meter.take({.tick = tick}, {1.0, 0.0}, {window});
    EXPECT_TRUE(meter.switches().empty());
}

}  // namespace zlg::study::variant_test
