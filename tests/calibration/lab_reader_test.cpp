#include <zlg/calibration/lab_reader.hpp>

#include "test.hpp"

using namespace zlg::calibration;
using zlg::core::HalfRecord;

namespace {

// Ten ticks of rest, three open, the rest closed in the other mode.
HalfRecord record(int half, int n_before = 10) {
    const int tick = half / 2;
    HalfRecord r;
    r.half = half;
    r.bias_sign = static_cast<std::int8_t>(half % 2 == 0 ? 1 : -1);
    r.mode = static_cast<std::int8_t>(tick < n_before ? 1 : -1);
    r.counts = r.bias_sign * r.mode * 150 + 2;
    r.loop_closed = tick < n_before || tick >= n_before + 3;
    r.detuning_sq_lambda2 = 1e-5;
    r.piezo_v = r.mode > 0 ? 100.0 : 140.0;
    r.temperature_c = 20.0 + 0.001 * half;
    return r;
}

LabLog read(int n_halves, int n_before = 10) {
    LabReader reader{"log", 0.005};
    for (int h = 0; h < n_halves; ++h) reader.take(record(h, n_before));
    return reader.finish();
}

}  // namespace

TEST(LabReader, segments_end_at_gaps_and_only_later_ones_are_re_locks) {
    const LabLog log = read(2 * 200 + 1);
    EXPECT_EQ(log.n_ticks, 200) << "an odd last half is dropped";
    ASSERT_EQ(log.segments.size(), 2u);
    EXPECT_FALSE(log.segments[0].after_gap);
    EXPECT_EQ(log.segments[0].n_ticks, 10);
    EXPECT_EQ(log.segments[0].n_settled, 0);
    EXPECT_EQ(log.segments[1].first_tick, 13);
    EXPECT_EQ(log.segments[1].mode, -1);
    EXPECT_EQ(log.segments[1].n_settled, 187 - settled_after_ticks);
    ASSERT_EQ(log.relocks.size(), 1u);
    EXPECT_EQ(log.relocks[0].halves.size(), relock_halves);
    EXPECT_EQ(log.relocks[0].halves.front().half, 26);
}

TEST(LabReader, blocks_sum_settled_ticks_only) {
    const LabLog log = read(2 * 200);
    std::int64_t ticks = 0;
    for (const Block& b : log.blocks) {
        ticks += b.n_ticks;
        EXPECT_EQ(b.counts, 4 * b.n_ticks);
        EXPECT_EQ(b.difference, 300 * b.n_ticks);
        EXPECT_LE(b.n_ticks, block_ticks);
        EXPECT_EQ(b.mode, -1);
        EXPECT_EQ(b.first_sign, -1);
    }
    EXPECT_EQ(ticks, 187 - settled_after_ticks);
    EXPECT_EQ(log.blocks.front().first_tick, 13 + settled_after_ticks);
    const Block& b = log.blocks.front();
    const double first_half = 2.0 * static_cast<double>(b.first_tick);
    EXPECT_NEAR(b.temperature_sum_c / static_cast<double>(2 * b.n_ticks), 20.0 + 0.001 * (first_half + 49.5), 1e-9);
    EXPECT_NEAR(b.last_temperature_c - b.first_temperature_c, 0.099, 1e-9);
}

TEST(LabReader, an_invalid_half_and_a_mode_without_gap_end_a_segment) {
    LabReader reader{"log", 0.005};
    for (int h = 0; h < 300; ++h) {
        HalfRecord r = record(h, 1000);
        if (h == 101) r.valid = false;
        if (h >= 200) r.mode = -1;
        reader.take(r);
    }
    const LabLog log = reader.finish();
    ASSERT_EQ(log.segments.size(), 3u);
    EXPECT_EQ(log.segments[0].n_ticks, 50);
    EXPECT_TRUE(log.segments[1].after_gap);
    EXPECT_EQ(log.segments[1].n_ticks, 49);
    EXPECT_FALSE(log.segments[2].after_gap);
}

TEST(LabReader, voltages_of_rest_are_means_of_the_windows_at_either_end) {
    const LabLog log = read(2 * 400, 200);
    ASSERT_EQ(log.segments.size(), 2u);
    EXPECT_EQ(log.segments[0].at_end.n, 2 * window_ticks);
    EXPECT_DOUBLE_EQ(log.segments[0].at_end.voltage_v, 100.0);
    EXPECT_DOUBLE_EQ(log.segments[1].at_start.voltage_v, 140.0);
    EXPECT_DOUBLE_EQ(log.segments[0].at_end.middle_ticks, 186.25);  // ends 8 readings before the segment
    EXPECT_DOUBLE_EQ(log.piezo_quantum_v, 40.0);
    EXPECT_EQ(slope_v_per_tick(log.segments[0]), 0.0);
}

TEST(LabReader, columns_that_are_missing_are_known_to_be) {
    LabReader reader{"log", 0.005};
    for (int h = 0; h < 400; ++h) {
        HalfRecord r = record(h);
        r.piezo_v = r.temperature_c = r.detuning_sq_lambda2 = std::numeric_limits<double>::quiet_NaN();
        reader.take(r);
    }
    const LabLog log = reader.finish();
    EXPECT_FALSE(log.has_piezo());
    EXPECT_FALSE(log.has_temperature());
    EXPECT_FALSE(log.has_square());
    EXPECT_EQ(log.segments[1].at_start.n, 0);
}
