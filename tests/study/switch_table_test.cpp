
#include <zlg/study/switch_table.hpp>

#include "test.hpp"

namespace zlg::switch_table_test {

using study::SwitchLine;
using study::SwitchTable;

constexpr int relock_ticks = 3;

// Ten ticks in mode 1, a gap of two, and `after` ticks in mode `mode_after`, the first half of them with this detuning.
// Every tick has a final row, as late as compensation may give it, in which 0.5 arcsec of false angle were subtracted.
std::vector<SwitchLine> lines(int after, std::int8_t mode_after, double detuning_lambda) {
    SwitchTable table{relock_ticks};
    const std::int64_t ticks = 12 + after;
    for (std::int64_t t = 0; t < ticks; ++t) {
        core::HalfRecord half;
        half.mode = t < 10 ? std::int8_t{1} : mode_after;
        half.loop_closed = t < 10 || t >= 12;
        half.detuning_lambda = t == 12 ? detuning_lambda : 0.5;
        table.take(t, half, half);
    }
    table.take(core::GapReport{.first_tick = 10,
                               .n_ticks = 2,
                               .mode_after = mode_after,
                               .mode_changed = mode_after != 1,
                               .dp_arcsec = 1.5,
                               .sigma_sum_arcsec = 2.5});
    for (std::int64_t t = 0; t < ticks; ++t) table.take(core::AngleRow{.tick = t, .relock_arcsec = 0.5});
    return table.lines();
}

TEST(SwitchTable, a_switch_has_what_records_and_compensation_say) {
    const auto all = lines(20, -1, -0.21);
    ASSERT_EQ(all.size(), 1u);
    const SwitchLine& line = all[0];
    EXPECT_EQ(line.tick, 10);
    EXPECT_EQ(line.mode, -1);
    EXPECT_EQ(line.gap_ticks, 2);
    EXPECT_EQ(line.miss_lambda, -0.21);
    EXPECT_EQ(line.dp_arcsec, 1.5);
    EXPECT_EQ(line.sigma_arcsec, 2.5);
    EXPECT_EQ(line.relock_arcsec, 0.5 * (2 + relock_ticks));
    EXPECT_TRUE(std::isnan(line.half_wave_v) && std::isinf(line.half_wave_sigma_v));
    EXPECT_TRUE(std::isnan(line.true_error_arcsec));
}

TEST(SwitchTable, a_re_lock_that_the_records_cut_off_is_not_known) {
    const auto all = lines(relock_ticks - 1, -1, -0.21);
    ASSERT_EQ(all.size(), 1u);
    EXPECT_TRUE(std::isnan(all[0].relock_arcsec));
}

TEST(SwitchTable, a_detuning_that_was_not_read_is_no_miss) {
    EXPECT_TRUE(std::isnan(lines(20, -1, 0.0).at(0).miss_lambda));
    EXPECT_TRUE(std::isnan(lines(20, -1, std::nan("")).at(0).miss_lambda));
}

TEST(SwitchTable, a_gap_in_one_mode_is_no_switch) { EXPECT_TRUE(lines(20, 1, 0.2).empty()); }

}  // namespace zlg::switch_table_test
