#include <zlg/rig/replay.hpp>

#include <zlg/rig/wiring.hpp>

#include "test.hpp"

namespace zlg::replay_test {

constexpr std::int64_t gap_tick = 60;
constexpr std::int64_t gap_ticks = 3;

core::GyroCompensationConfig of_bridge(core::BridgeMethod bridge) {
    config::Config c;
    c.gyro.scale_arcsec = 2.0;
    c.drift = {.magnetic_arcsec_s = 0.0, .magnetic_thermal_arcsec_s = 0.0, .nonmagnetic_arcsec_s = 0.0};
    return rig::compensation_config(c, core::RelockMethod::none, bridge);
}

// A bias of 100 counts a half, and a rotation of tick + 1 counts a tick, all of it in the first half.
core::HalfRecord record(std::int64_t half) {
    const bool is_first = half % 2 == 0;
    return {.half = half,
            .counts = is_first ? 100 + half / 2 + 1 : -100,
            .bias_sign = static_cast<std::int8_t>(is_first ? 1 : -1)};
}

// The helicity changes in the gap.
core::HalfRecord record_with_gap(std::int64_t half) {
    core::HalfRecord made = record(half);
    made.loop_closed = half / 2 < gap_tick || half / 2 >= gap_tick + gap_ticks;
    if (half / 2 >= gap_tick) made.mode = -1;
    return made;
}

struct Collected {
    std::vector<core::AngleRow> rows;
    std::vector<core::GapReport> gaps;

    auto on_row() {
        return [this](const core::AngleRow& row) { rows.push_back(row); };
    }
    auto on_gap() {
        return [this](const core::GapReport& gap) { gaps.push_back(gap); };
    }
};

TEST(Replay, gives_each_whole_tick_one_row_in_their_order) {
    for (const auto bridge : {core::BridgeMethod::none, core::BridgeMethod::quadratic, core::BridgeMethod::automatic}) {
        rig::Replay replay{of_bridge(bridge)};
        Collected got;
        for (std::int64_t half = 0; half < 2 * 90 + 1; ++half) replay.take(record(half), {}, got.on_row());
        replay.end(got.on_row());
        ASSERT_EQ(got.rows.size(), 90u);
        for (std::int64_t tick = 0; tick < 90; ++tick) {
            const core::AngleRow& row = got.rows[static_cast<std::size_t>(tick)];
            EXPECT_EQ(row.tick, tick);
            EXPECT_DOUBLE_EQ(row.dtheta_final_arcsec, 2.0 * static_cast<double>(tick + 1));
        }
        EXPECT_EQ(replay.halves(), 181);
        EXPECT_DOUBLE_EQ(replay.angle_arcsec(), 2.0 * 90.0 * 91.0 / 2.0) << "1 + 2 + ... + 90 counts";
    }
}

TEST(Replay, a_gap_is_handed_over_once_and_its_ticks_have_rows_too) {
    rig::Replay replay{of_bridge(core::BridgeMethod::quadratic)};
    Collected got;
    for (std::int64_t half = 0; half < 2 * 200; ++half)
        replay.take(record_with_gap(half), {}, got.on_row(), got.on_gap());
    ASSERT_EQ(got.gaps.size(), 1u);
    replay.end(got.on_row(), got.on_gap());
    EXPECT_EQ(got.rows.size(), 200u);
    ASSERT_EQ(got.gaps.size(), 1u);
    EXPECT_EQ(got.gaps[0].first_tick, gap_tick);
    EXPECT_EQ(got.gaps[0].n_ticks, gap_ticks);
    EXPECT_TRUE(got.gaps[0].mode_changed);
}

// The bridge waits for two ticks after the gap, and the log has one.
TEST(Replay, a_gap_that_still_waits_is_handed_over_at_the_end) {
    rig::Replay replay{of_bridge(core::BridgeMethod::quadratic)};
    Collected got;
    for (std::int64_t half = 0; half < 2 * (gap_tick + gap_ticks + 1); ++half)
        replay.take(record_with_gap(half), {}, got.on_row(), got.on_gap());
    EXPECT_TRUE(got.gaps.empty());
    replay.end(got.on_row(), got.on_gap());
    ASSERT_EQ(got.gaps.size(), 1u);
    EXPECT_EQ(got.gaps[0].n_ticks, gap_ticks);
    EXPECT_EQ(got.rows.size(), static_cast<std::size_t>(gap_tick + gap_ticks + 1));
}

TEST(Replay, what_is_returned_is_what_is_handed_over) {
    rig::Replay replay{of_bridge(core::BridgeMethod::quadratic)};
    Collected handed;
    Collected returned;
    for (std::int64_t half = 0; half < 2 * 200; ++half) {
        const auto out = replay.take(record_with_gap(half), {}, handed.on_row(), handed.on_gap());
        EXPECT_EQ(out.has_sample, half % 2 == 1);
        rig::hand_over(out.sample, returned.on_row(), returned.on_gap());
    }
    EXPECT_EQ(returned.rows, handed.rows);
    EXPECT_EQ(returned.gaps, handed.gaps);
}

TEST(Replay, a_copy_goes_on_like_the_original) {
    rig::Replay replay{of_bridge(core::BridgeMethod::automatic)};
    for (std::int64_t half = 0; half < 2 * gap_tick + 3; ++half) replay.take(record_with_gap(half));
    rig::Replay copy = replay;
    for (std::int64_t half = 2 * gap_tick + 3; half < 400; ++half) replay.take(record_with_gap(half));
    for (std::int64_t half = 2 * gap_tick + 3; half < 400; ++half) copy.take(record_with_gap(half));
    EXPECT_EQ(copy.state(), replay.state());
    EXPECT_EQ(copy.angle_arcsec(), replay.angle_arcsec());
}

TEST(Replay, the_rest_ends_where_there_is_neither_row_nor_gap) {
    std::vector<core::DrainOutput> script(6);
    script[0].has_row = true;
    script[1].has_gap = true;
    script[2].has_row = script[2].has_gap = true;
    script[4].has_row = true;  // after the end
    std::size_t asked = 0;
    Collected got;
    rig::hand_over_rest([&] { return script[asked++]; }, got.on_row(), got.on_gap());
    EXPECT_EQ(asked, 4u);
    EXPECT_EQ(got.rows.size(), 2u);
    EXPECT_EQ(got.gaps.size(), 2u);
}

TEST(Replay, a_half_without_the_other_one_is_named) {
    rig::Replay replay{of_bridge(core::BridgeMethod::none)};
    EXPECT_EQ(replay.odd_half("log"), "");
    replay.take(record(0));
    zlg::test::expect_contains(replay.odd_half("log"), "log: the last half-period (0)");
    replay.take(record(1));
    EXPECT_EQ(replay.odd_half("log"), "");
    replay.take(record(2));
    zlg::test::expect_contains(replay.odd_half("log"), "log: the last half-period (2)");
}

}  // namespace zlg::replay_test
