#include <zlg/logs/error.hpp>
#include <zlg/study/axis_records.hpp>

#include "test.hpp"

namespace zlg::axis_records_test {

core::AngleRow row(std::int64_t tick, double angle, std::uint32_t flags = 0) {
    return {.tick = tick, .dtheta_final_arcsec = angle, .mode = 1, .flags = flags};
}

TEST(TickRates, an_angle_is_a_rate_and_a_bridged_one_is_missing) {
    study::TickRates ticks{"folder/a.h5", 0.5};
    ticks.take(row(0, 2.0));
    ticks.take(row(1, 3.0, core::flag_interpolated));
    std::vector<study::AxisRecord> axes;
    ticks.finish(axes);
    ASSERT_EQ(axes.size(), 1u);
    EXPECT_EQ(axes[0].name, "a.h5");
    EXPECT_EQ(axes[0].rate_hz, 2.0);
    EXPECT_EQ(axes[0].rates_arcsec_s[0], 4.0);
    EXPECT_TRUE(std::isnan(axes[0].rates_arcsec_s[1]));
    EXPECT_EQ(axes[0].bridged_arcsec_s[1], 6.0);
}

TEST(TickRates, where_every_tick_has_its_truth_there_is_an_error) {
    study::TickRates ticks{"a.h5", 0.5};
    ticks.take(row(0, 2.0), 1.5);
    std::vector<study::AxisRecord> axes;
    ticks.finish(axes);
    ASSERT_EQ(axes.size(), 2u);
    EXPECT_TRUE(axes[1].is_error);
    EXPECT_EQ(axes[1].rates_arcsec_s[0], 1.0);
}

TEST(AxisOf, a_column_keeps_all_that_was_read_and_is_named_by_its_file) {
    const study::AxisRecord axis = study::axis_of("folder/b.csv", {.name = "w",
                                                                   .holds = "rates, deg/s",
                                                                   .rate_hz = 10.0,
                                                                   .rates_arcsec_s = {1.0, 2.0},
                                                                   .phase_arcsec = {0.0, 0.1, 0.3},
                                                                   .mode = {1, -1},
                                                                   .warnings = {"held"}});
    EXPECT_EQ(axis.name, "b.csv, w");
    EXPECT_EQ(axis.group, "folder/b.csv");
    EXPECT_EQ(axis.holds, "rates, deg/s");
    EXPECT_EQ(axis.rate_hz, 10.0);
    EXPECT_EQ(axis.rates_arcsec_s, (std::vector{1.0, 2.0}));
    EXPECT_EQ(axis.phase_arcsec, (std::vector{0.0, 0.1, 0.3}));
    EXPECT_EQ(axis.mode, (std::vector<std::int8_t>{1, -1}));
    EXPECT_EQ(axis.warnings, std::vector<std::string>{"held"});
}

TEST(TickRates, times_that_contradict_the_tick_are_refused) {
    const logs::TimedAngle last{.row = row(100, 0.0), .t_s = 51.0};
    EXPECT_NE(test::message_of<logs::FormatError>([&] { study::check_tick("a.csv", 0.5, 0.5, last); }), "");
    study::check_tick("a.csv", 0.505, 0.5, last);
}

}  // namespace zlg::axis_records_test
