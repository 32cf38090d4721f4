#include <zlg/logs/wire_rows.hpp>

#include "line_gyro.hpp"

namespace zlg::logs::wire_rows_test {

TEST(WireRows, OfAGoodLineAreTheRowsOfTheGyro) {
    Gyro gyro;
    WireRows rows;
    for (int k = 0; k < 100; ++k) rows.take(gyro.tick());
    rows.take(gyro.status());
    rows.take(gyro.drain());
    rows.end();
    EXPECT_EQ(rows_of(rows), gyro.rows);
    EXPECT_EQ(rows.tick_s(), 0.005);
    ASSERT_TRUE(rows.status().has_value());
    EXPECT_EQ(rows.status()->scale_arcsec, 3.0);
    const WireSummary& s = rows.summary();
    EXPECT_EQ(s.n_telemetry, 107u);
    EXPECT_EQ(s.n_status, 1u);
    EXPECT_EQ(s.n_rows, 100u);
    EXPECT_EQ(s.n_lost_messages + s.n_lost_rows + s.n_final_lost_rows + s.n_damaged + s.n_restarts + s.n_refused, 0u);
    EXPECT_NEAR(s.angle_arcsec, sum(gyro.rows, &core::AngleRow::dtheta_arcsec), 1e-9);
}

TEST(WireRows, WhatIsNotSettledAtTheEndIsToldAsDelivered) {
    Gyro gyro;
    WireRows rows;
    for (int k = 0; k < 20; ++k) rows.take(gyro.tick());
    rows.end();
    const auto got = rows_of(rows);
    ASSERT_EQ(got.size(), 20u);
    for (std::size_t k = 0; k < 20; ++k) {
        const bool settled = k < 20 - delay_ticks;
        EXPECT_EQ(got[k].dtheta_arcsec, gyro.rows[k].dtheta_arcsec);
        EXPECT_EQ(got[k].dtheta_final_arcsec, settled ? gyro.rows[k].dtheta_final_arcsec : gyro.rows[k].dtheta_arcsec);
        EXPECT_EQ(got[k].sigma_arcsec, settled ? 1.5 : inf);
        EXPECT_EQ(got[k].flags, gyro.rows[k].flags | (settled ? 0u : flag_final_lost));
    }
    EXPECT_EQ(rows.summary().n_final_lost_rows, static_cast<std::uint64_t>(delay_ticks));
}

// Ticks [from, to) do not arrive.
std::vector<core::AngleRow> with_hole(Gyro& gyro, WireRows& rows, int n, int from, int to) {
    for (int k = 0; k < n; ++k) {
        const Bytes bytes = gyro.tick();
        if (k < from || k >= to) rows.take(bytes);
    }
    rows.take(gyro.drain());
    rows.end();
    return rows_of(rows);
}

TEST(WireRows, AShortLossTakesOnlyFinalValues) {
    Gyro gyro;
    WireRows rows;
    const auto got = with_hole(gyro, rows, 100, 50, 50 + delay_ticks);
    ASSERT_EQ(got.size(), 100u);
    expect_numbered(got);
    for (std::size_t k = 0; k < 100; ++k) {
        EXPECT_EQ(got[k].dtheta_arcsec, gyro.rows[k].dtheta_arcsec) << k;
        const bool lost = k >= 50 - delay_ticks && k < 50;
        EXPECT_EQ(got[k].flags, gyro.rows[k].flags | (lost ? flag_final_lost : 0u)) << k;
        EXPECT_EQ(got[k].sigma_arcsec, lost ? inf : 1.5);
        if (!lost) EXPECT_EQ(got[k], gyro.rows[k]);
    }
    EXPECT_NEAR(sum(got, &core::AngleRow::dtheta_final_arcsec), sum(gyro.rows, &core::AngleRow::dtheta_final_arcsec),
                1e-7);
    EXPECT_EQ(rows.summary().n_lost_messages, static_cast<std::uint64_t>(delay_ticks));
    EXPECT_EQ(rows.summary().n_lost_rows, 0u);
    EXPECT_EQ(rows.summary().n_final_lost_rows, static_cast<std::uint64_t>(delay_ticks));
}

TEST(WireRows, ALongLossLosesNoAngle) {
    Gyro gyro;
    WireRows rows;
    const auto got = with_hole(gyro, rows, 500, 70, 300);
    ASSERT_EQ(got.size(), 500u);
    expect_numbered(got);
    const std::size_t first = 70;
    const std::size_t end = 300 - delay_ticks;
    double lost_arcsec = 0.0;
    for (std::size_t k = first; k < end; ++k) lost_arcsec += gyro.rows[k].dtheta_arcsec;
    for (std::size_t k = 0; k < 500; ++k) {
        const bool lost = k >= first && k < end;
        EXPECT_EQ((got[k].flags & flag_lost) != 0, lost) << k;
        if (lost) EXPECT_NEAR(got[k].dtheta_arcsec, lost_arcsec / static_cast<double>(end - first), 1e-8) << k;
        // The last one that was sent.
        if (lost) EXPECT_EQ(got[k].mode, -1) << k;
        if (!lost) EXPECT_EQ(got[k].dtheta_arcsec, gyro.rows[k].dtheta_arcsec) << k;
        if (k < first - delay_ticks || k >= end) EXPECT_EQ(got[k], gyro.rows[k]);
    }
    EXPECT_NEAR(sum(got, &core::AngleRow::dtheta_arcsec), sum(gyro.rows, &core::AngleRow::dtheta_arcsec), 1e-7);
    EXPECT_NEAR(sum(got, &core::AngleRow::dtheta_final_arcsec), sum(gyro.rows, &core::AngleRow::dtheta_final_arcsec),
                1e-7);
    EXPECT_EQ(rows.summary().n_lost_messages, 230u);
    EXPECT_EQ(rows.summary().n_lost_rows, end - first);
}

TEST(WireRows, NumbersOfMessagesAndTicksWrap) {
    // Both counters pass 2^32 in the middle of the loss.
    Gyro gyro{1, 0xFFFFFFC0, 0xFFFFFFC0};
    WireRows rows;
    for (int k = 0; k < 200; ++k) {
        const Bytes bytes = gyro.tick();
        if (k >= 20 && (k < 50 || k >= 120)) rows.take(bytes);
    }
    rows.take(gyro.drain());
    rows.end();
    const auto got = rows_of(rows);
    // It joined in tick 20, in which tick 13 was settled.
    ASSERT_EQ(got.size(), 200u - 13);
    EXPECT_EQ(rows.summary().n_lost_messages, 70u);
    EXPECT_EQ(rows.summary().n_restarts, 0u);
    const std::vector<core::AngleRow> sent{gyro.rows.begin() + 13, gyro.rows.end()};
    EXPECT_NEAR(sum(got, &core::AngleRow::dtheta_arcsec), sum(sent, &core::AngleRow::dtheta_arcsec), 1e-7);
    EXPECT_EQ(got.back().dtheta_arcsec, sent.back().dtheta_arcsec);
}

TEST(WireRows, WhoJoinsLateBeginsWithTheTickThatIsSettledThen) {
    Gyro gyro;
    WireRows rows;
    for (int k = 0; k < 60; ++k) {
        const Bytes bytes = gyro.tick();
        // In the middle of a frame.
        if (k == 39) rows.take(std::span{bytes}.subspan(50));
        if (k >= 40) rows.take(bytes);
    }
    rows.take(gyro.drain());
    rows.end();
    const auto got = rows_of(rows);
    ASSERT_EQ(got.size(), 60u - 40 + delay_ticks);
    for (std::size_t k = 0; k < got.size(); ++k) {
        core::AngleRow expected = gyro.rows[40 - delay_ticks + k];
        expected.tick = static_cast<std::int64_t>(k);
        EXPECT_EQ(got[k], expected);
    }
    EXPECT_EQ(rows.summary().n_lost_rows, 0u);
}

TEST(WireRows, WhoJoinsBeforeAnythingIsSettledMissesNothing) {
    Gyro gyro;
    WireRows rows;
    for (int k = 0; k < 30; ++k) {
        const Bytes bytes = gyro.tick();
        if (k >= 3) rows.take(bytes);
    }
    rows.take(gyro.drain());
    rows.end();
    EXPECT_EQ(rows_of(rows), gyro.rows);
}

TEST(WireRows, AfterARestartTheLogGoesOn) {
    // With a number of starts that is counted; and without, shown by other messages of the same numbers.
    for (const std::uint16_t second_session : {std::uint16_t{2}, std::uint16_t{1}}) {
        Gyro first;
        Gyro second{second_session, 0, 0, 77.0};
        WireRows rows;
        for (int k = 0; k < 50; ++k) rows.take(first.tick());
        for (int k = 0; k < 30; ++k) rows.take(second.tick());
        rows.take(second.drain());
        rows.end();
        const auto got = rows_of(rows);
        ASSERT_EQ(got.size(), 80u);
        expect_numbered(got);
        EXPECT_EQ(got[49].dtheta_arcsec, first.rows[49].dtheta_arcsec);
        EXPECT_EQ(got[49].flags, first.rows[49].flags | flag_final_lost);
        EXPECT_EQ(got[50].flags, second.rows[0].flags | flag_restarted);
        for (std::size_t k = 0; k < 80; ++k) {
            EXPECT_EQ((got[k].flags & flag_restarted) != 0, k == 50) << k;
            EXPECT_EQ(got[k].dtheta_arcsec, k < 50 ? first.rows[k].dtheta_arcsec : second.rows[k - 50].dtheta_arcsec);
        }
        EXPECT_EQ(rows.summary().n_restarts, 1u);
        EXPECT_EQ(rows.summary().n_lost_rows, 0u);
    }
}

TEST(WireRows, ASessionThatIsFartherThanTheLastOneIsARestartToo) {
    Gyro first;
    Gyro second{2, 100};
    WireRows rows;
    for (int k = 0; k < 10; ++k) rows.take(first.tick());
    for (int k = 0; k < 50; ++k) {
        const Bytes bytes = second.tick();
        if (k >= 30) rows.take(bytes);
    }
    rows.end();
    EXPECT_EQ(rows.summary().n_restarts, 1u);
    EXPECT_EQ(rows.summary().n_lost_messages, 0u);
    EXPECT_EQ(rows_of(rows).size(), 10u + 20 + delay_ticks);
}

TEST(WireRows, MeasuringAnewInOneSessionIsARestart) {
    for (const int n_first : {2, 50}) {
        Gyro first;
        Gyro again{1, static_cast<std::uint32_t>(n_first)};
        WireRows rows;
        for (int k = 0; k < n_first; ++k) rows.take(first.tick());
        for (int k = 0; k < 20; ++k) rows.take(again.tick());
        rows.end();
        EXPECT_EQ(rows.summary().n_restarts, 1u) << n_first;
        EXPECT_EQ(rows.summary().n_lost_messages, 0u);
        EXPECT_EQ(rows_of(rows).size(), static_cast<std::size_t>(n_first + 20));
    }
}

TEST(WireRows, OnlyOneRowBeginsAnewThoughItIsLost) {
    Gyro first;
    Gyro second{2};
    WireRows rows;
    for (int k = 0; k < 30; ++k) rows.take(first.tick());
    for (int k = 0; k < 60; ++k) {
        const Bytes bytes = second.tick();
        if (k == 3 || k >= 40) rows.take(bytes);
    }
    rows.end();
    const auto got = rows_of(rows);
    ASSERT_EQ(got.size(), 90u);
    for (std::size_t k = 0; k < 90; ++k) EXPECT_EQ((got[k].flags & flag_restarted) != 0, k == 30) << k;
    EXPECT_NE(got[30].flags & flag_lost, 0u);
}

TEST(WireRows, AGyroThatNeverSettlesMakesNoRow) {
    Gyro gyro{1, 0, 100'000};
    WireRows rows;
    for (int k = 0; k < 5; ++k) rows.take(gyro.tick());
    rows.end();
    EXPECT_TRUE(rows_of(rows).empty());
}

TEST(WireRows, ARowThatIsThereAlreadyIsNotTakenAgain) {
    wire::Sender sender{.session = 1};
    WireRows rows;
    wire::Telemetry t{.tick = 10, .has_settled = true, .settled_age_ticks = 5, .tick_s = 0.005};
    rows.take(frame_of(sender, t).view());
    t.tick = 11;
    t.settled_age_ticks = 7;
    rows.take(frame_of(sender, t).view());
    EXPECT_EQ(rows_of(rows).size(), 1u);
}

TEST(WireRows, CommandsOnTheSameLineAreNotTheGyros) {
    Gyro gyro;
    wire::Sender host{.session = 1234, .sequence = 77};
    WireRows rows;
    for (int k = 0; k < 30; ++k) {
        rows.take(gyro.tick());
        const wire::Frame frame = frame_of(host, wire::MessageType::command, std::array<std::uint8_t, 2>{1, 0});
        rows.take(frame.view());
    }
    rows.take(gyro.drain());
    rows.end();
    EXPECT_EQ(rows_of(rows), gyro.rows);
    EXPECT_EQ(rows.summary().n_restarts, 0u);
}

TEST(WireRows, NoiseAloneMakesNoRow) {
    std::mt19937_64 random{5};
    WireRows rows;
    Bytes noise(1'000'000);
    for (std::uint8_t& byte : noise) byte = static_cast<std::uint8_t>(random());
    rows.take(noise);
    rows.end();
    EXPECT_TRUE(rows_of(rows).empty());
    EXPECT_FALSE(rows.tick_s().has_value());
    EXPECT_EQ(rows.summary().n_bytes, noise.size());
    EXPECT_GT(rows.summary().n_damaged, 3000u);
}

// Whatever happens to the line: what is not flagged is right, and the angle between two right rows too.
void expect_true_to(const std::vector<core::AngleRow>& got, const std::vector<core::AngleRow>& sent, std::size_t from) {
    double error_arcsec = 0.0;
    double final_error_arcsec = 0.0;
    for (std::size_t k = 0; k < got.size(); ++k) {
        const core::AngleRow& right = sent[from + k];
        const bool lost = (got[k].flags & flag_lost) != 0;
        const bool final_lost = (got[k].flags & flag_final_lost) != 0;
        error_arcsec += got[k].dtheta_arcsec - right.dtheta_arcsec;
        final_error_arcsec += got[k].dtheta_final_arcsec - right.dtheta_final_arcsec;
        if (!lost) {
            ASSERT_EQ(got[k].dtheta_arcsec, right.dtheta_arcsec) << k;
            ASSERT_EQ(got[k].mode, right.mode) << k;
        }
        if (final_lost) continue;
        ASSERT_FALSE(lost);
        ASSERT_EQ(got[k].dtheta_final_arcsec, right.dtheta_final_arcsec) << k;
        ASSERT_EQ(got[k].sigma_arcsec, right.sigma_arcsec) << k;
        ASSERT_EQ(got[k].flags, right.flags) << k;
        ASSERT_NEAR(error_arcsec, 0.0, 1e-4) << k;
        ASSERT_NEAR(final_error_arcsec, 0.0, 1e-4) << k;
    }
}

TEST(WireRows, OfALineThatLosesATenthOfItsBytesWhatIsNotFlaggedIsRight) {
    for (const int burst_bytes : {1, 30, 1000}) {
        std::mt19937_64 random{7};
        Gyro gyro;
        WireRows rows;
        int left_in_burst = 0;
        bool lost = false;
        std::size_t first_row = 0;
        bool joined = false;
        for (int k = 0; k < 60'000; ++k) {
            Bytes arriving;
            for (const std::uint8_t byte : gyro.tick()) {
                if (left_in_burst-- <= 0) {
                    lost = random() % 10 == 0;
                    left_in_burst = burst_bytes - 1;
                }
                if (!lost) arriving.push_back(byte);
            }
            rows.take(arriving);
            if (!joined && rows.summary().n_telemetry > 0) {
                joined = true;
                first_row = k < delay_ticks ? 0 : static_cast<std::size_t>(k - delay_ticks);
            }
        }
        rows.end();
        const auto got = rows_of(rows);
        if (burst_bytes > 1) ASSERT_GT(got.size(), 59'000u);
        ASSERT_LE(first_row + got.size(), gyro.rows.size());
        expect_true_to(got, gyro.rows, first_row);
        if (burst_bytes == 1000) EXPECT_LT(rows.summary().n_lost_rows, 12'000u);
        EXPECT_EQ(rows.summary().n_restarts, 0u);
    }
}

}  // namespace zlg::logs::wire_rows_test
