#include "gap_bridge_support.hpp"

namespace zlg::core::gap_bridge_support::gap_bridge_test {

constexpr BridgeMethod all_bridges[] = {BridgeMethod::constant, BridgeMethod::linear, BridgeMethod::quadratic};

GapBridgeConfig config_of(BridgeMethod method) { return {.method = method}; }

// Ticks of a motion given tick by tick; those in [first, first + n) are a gap.
Log log_of(int n_ticks, int first, int n, const std::function<double(int)>& motion) {
    Log log;
    for (int k = 0; k < n_ticks; ++k)
        log.push_back(k >= first && k < first + n ? gap_tick() : measured_tick(motion(k)));
    return log;
}

double parabola(int k) { return 7.0 - 1.25 * k + 0.125 * k * k; }

double motion_of_order(int order, int k) { return order == 0 ? 7.0 : order == 1 ? 7.0 - 1.25 * k : parabola(k); }

TEST(GapBridge, PolynomialsOfItsOrderPassWithoutError) {
    for (const BridgeMethod method : all_bridges)
        for (int n = 1; n <= max_polynomial_gap; ++n)
            for (int before = 1; before <= 8; ++before)
                for (int after = 1; after <= 8; ++after) {
                    GapBridgeConfig config{.method = method, .points_before = before, .points_after = after};
                    if (!is_allowed(config)) continue;
                    const auto motion = [&](int k) { return motion_of_order(order_of(method), k); };
                    const Delivered got = run(config, log_of(50, 15, n, motion));
                    for (int k = 0; k < 50; ++k) {
                        const AngleRow& row = got.rows[static_cast<unsigned>(k)];
                        ASSERT_NEAR(row.dtheta_final_arcsec, motion(k), 1e-9);
                        ASSERT_NEAR(row.dtheta_arcsec, motion(k), 1e-9);
                    }
                    ASSERT_EQ(got.gaps.size(), 1u);
                    EXPECT_NEAR(got.gaps[0].dp_arcsec, 0.0, 1e-9);
                }
}

TEST(GapBridge, TheStandardGapHasTheWeightsOfThePaper) {
    // One arcsec in the last tick before the gap, nothing elsewhere.
    const auto impulse = [](int k) { return k == 9 ? 1.0 : 0.0; };
    const Delivered got = run(config_of(BridgeMethod::quadratic), log_of(20, 10, 3, impulse));
    const double extrapolated[] = {9.0 / 4.0, 81.0 / 20.0, 127.0 / 20.0};
    const double interpolated[] = {57.0 / 65.0, 0.9, 47.0 / 65.0};
    for (unsigned j = 0; j < 3; ++j) {
        EXPECT_NEAR(got.samples[10 + j].dtheta_arcsec, extrapolated[j], 1e-14);
        EXPECT_NEAR(got.rows[10 + j].dtheta_final_arcsec, interpolated[j], 1e-14);
        EXPECT_EQ(got.rows[10 + j].flags, flag_extrapolated | flag_interpolated);
    }
    // j = n + 1 + points_after carries the difference.
    EXPECT_NEAR(got.rows[15].dtheta_arcsec, 2.5 - 253.0 / 20.0, 1e-13);
    EXPECT_EQ(got.rows[15].flags, flag_correction);
    EXPECT_EQ(got.rows[15].dtheta_final_arcsec, 0.0);
    EXPECT_NEAR(got.gaps[0].dp_arcsec, 253.0 / 20.0 - 2.5, 1e-13);
    for (const unsigned k : {13u, 14u, 16u, 17u}) EXPECT_EQ(got.rows[k].flags, 0u) << k;
}

TEST(GapBridge, WhatTheCounterReadsInAGapShowsNowhere) {
    Random random{1};
    for (int trial = 0; trial < 50; ++trial) {
        const GapBridgeConfig config = random_config(random);
        if (config.method == BridgeMethod::none) continue;
        Log log = random_log(random, 150);
        const Delivered before = run(config, log);
        for (TickInput& tick : log)
            if (!tick.measured) tick.value_arcsec = random.uniform(-1e9, 1e9);
        EXPECT_EQ(run(config, log).rows, before.rows);
    }
}

TEST(GapBridge, MethodNonePassesTheTicksAsRead) {
    Log log = log_of(30, 10, 3, parabola);
    log[20] = gap_tick(-1);
    const Delivered got = run(config_of(BridgeMethod::none), log);
    for (std::size_t k = 0; k < log.size(); ++k) {
        EXPECT_EQ(got.rows[k].dtheta_arcsec, log[k].value_arcsec);
        EXPECT_EQ(got.rows[k].dtheta_final_arcsec, log[k].value_arcsec);
        EXPECT_EQ(std::isinf(got.rows[k].sigma_arcsec), !log[k].measured);
        EXPECT_FALSE(has(got.rows[k].flags, flag_extrapolated) || has(got.rows[k].flags, flag_interpolated));
    }
    EXPECT_TRUE(has(got.rows[20].flags, flag_switching));
    EXPECT_FALSE(has(got.rows[11].flags, flag_switching));
}

TEST(GapBridge, TheCorrectionWaitsForAMeasuredTick) {
    // The correction of the gap 10..12 is due at tick 15, in the next gap, which ends at 18.
    Log log = log_of(40, 10, 3, [](int k) { return k == 9 ? 1.0 : 0.0; });
    for (unsigned k = 15; k < 19; ++k) log[k] = gap_tick();
    const Delivered got = run(config_of(BridgeMethod::quadratic), log);
    for (unsigned k = 15; k < 19; ++k) EXPECT_FALSE(has(got.rows[k].flags, flag_correction)) << k;
    EXPECT_TRUE(has(got.rows[19].flags, flag_correction));
    EXPECT_NEAR(got.rows[19].dtheta_arcsec, 2.5 - 253.0 / 20.0, 1e-12);
    EXPECT_TRUE(has(got.rows[21].flags, flag_correction));
    // The lump is no motion: no fit may see it.
    EXPECT_EQ(got.rows[19].dtheta_final_arcsec, 0.0);
}

TEST(GapBridge, LumpsStayOutOfLaterExtrapolations) {
    // Tick 15 carries a lump of -10.15 and is the tick before the gap 16..17.
    Log log = log_of(40, 10, 3, [](int k) { return k == 9 ? 1.0 : 0.0; });
    log[16] = log[17] = gap_tick();
    const Delivered got = run(config_of(BridgeMethod::quadratic), log);
    EXPECT_NEAR(got.rows[15].dtheta_arcsec, 2.5 - 253.0 / 20.0, 1e-12);
    for (const unsigned k : {16u, 17u}) {
        EXPECT_EQ(got.rows[k].dtheta_arcsec, 0.0);
        EXPECT_EQ(got.rows[k].dtheta_final_arcsec, 0.0);
    }
}

TEST(GapBridge, AtTheStartTheTicksAfterAreUsedInReversedTime) {
    for (const BridgeMethod method : all_bridges) {
        const auto motion = [&](int k) { return motion_of_order(order_of(method), k); };
        const Delivered got = run(config_of(method), log_of(20, 0, 3, motion));
        double lump = 0.0;
        for (int k = 0; k < 3; ++k) {
            const AngleRow& row = got.rows[static_cast<unsigned>(k)];
            EXPECT_EQ(row.dtheta_arcsec, 0.0);
            EXPECT_NEAR(row.dtheta_final_arcsec, motion(k), 1e-12);
            EXPECT_FALSE(has(row.flags, flag_interpolated) || has(row.flags, flag_unrepaired));
            EXPECT_TRUE(std::isfinite(row.sigma_arcsec));
            lump += motion(k);
        }
        // Four points of the other side are needed: the correction is in the tick after the fourth.
        EXPECT_NEAR(got.rows[7].dtheta_arcsec, motion(7) + lump, 1e-11);
        EXPECT_TRUE(has(got.rows[7].flags, flag_correction));
        EXPECT_TRUE(got.gaps.empty());
    }
}

TEST(GapBridge, AtTheEndTheExtrapolationIsTheBestThereIs) {
    const Delivered got = run(config_of(BridgeMethod::quadratic), log_of(20, 17, 3, parabola));
    ASSERT_EQ(got.rows.size(), 20u);
    for (unsigned k = 17; k < 20; ++k) {
        EXPECT_NEAR(got.rows[k].dtheta_arcsec, parabola(static_cast<int>(k)), 1e-10);
        EXPECT_EQ(got.rows[k].dtheta_final_arcsec, got.rows[k].dtheta_arcsec);
        EXPECT_EQ(got.rows[k].flags, flag_extrapolated);
        EXPECT_TRUE(std::isfinite(got.rows[k].sigma_arcsec));
    }
    EXPECT_TRUE(got.gaps.empty());
}

TEST(GapBridge, OneTickAfterTheGapIsEnoughAtTheEnd) {
    const Delivered got = run(config_of(BridgeMethod::quadratic), log_of(20, 16, 3, parabola));
    for (unsigned k = 16; k < 19; ++k) {
        EXPECT_NEAR(got.rows[k].dtheta_final_arcsec, parabola(static_cast<int>(k)), 1e-10);
        EXPECT_TRUE(has(got.rows[k].flags, flag_interpolated));
        EXPECT_FALSE(has(got.rows[k].flags, flag_lower_order));  // three points are enough
    }
    ASSERT_EQ(got.gaps.size(), 1u);
}

TEST(GapBridge, TooFewPointsLowerTheOrderAndSaySo) {
    // One tick, a gap, one tick: a straight line through the two.
    const Delivered got =
        run(config_of(BridgeMethod::quadratic), {measured_tick(10.0), gap_tick(), gap_tick(), measured_tick(16.0)});
    for (const unsigned k : {1u, 2u}) {
        EXPECT_EQ(got.rows[k].dtheta_arcsec, 10.0);
        EXPECT_NEAR(got.rows[k].dtheta_final_arcsec, 10.0 + 2.0 * k, 1e-12);
        EXPECT_TRUE(has(got.rows[k].flags, flag_lower_order) && has(got.rows[k].flags, flag_interpolated));
        EXPECT_TRUE(has(got.samples[k].flags, flag_lower_order));
    }
}

TEST(GapBridge, IslandsOfOneTickAreBridgedFromOneAnother) {
    // Every second tick of a parabola is missing. Standard positions -1..0 and 2..3 hold one measured tick each, so
    // the final value is on the chord. Wider points reach over the islands.
    Log log;
    for (int k = 0; k < 100; ++k) log.push_back(k % 2 == 1 ? gap_tick() : measured_tick(parabola(k)));
    const Delivered got = run(config_of(BridgeMethod::quadratic), log);
    const Delivered wider = run({.extrapolation_points = 8, .points_before = 8, .points_after = 8}, log);
    for (int k = 1; k < 99; k += 2) {
        const AngleRow& row = got.rows[static_cast<unsigned>(k)];
        EXPECT_NEAR(row.dtheta_final_arcsec, 0.5 * (parabola(k - 1) + parabola(k + 1)), 1e-9) << k;
        EXPECT_TRUE(has(row.flags, flag_lower_order) && has(row.flags, flag_interpolated));
        if (k >= 20 && k < 80)
            EXPECT_NEAR(wider.rows[static_cast<unsigned>(k)].dtheta_final_arcsec, parabola(k), 1e-9) << k;
    }
}

TEST(GapBridge, SixteenTicksAreBridgedSeventeenAreNot) {
    for (const int n : {16, 17}) {
        const Delivered got = run(config_of(BridgeMethod::quadratic), log_of(60, 20, n, parabola));
        const double mean = (parabola(16) + parabola(17) + parabola(18) + parabola(19)) / 4.0;
        for (int k = 20; k < 20 + n; ++k) {
            const AngleRow& row = got.rows[static_cast<unsigned>(k)];
            EXPECT_NEAR(row.dtheta_arcsec, k < 36 ? parabola(k) : mean, 1e-9);  // delivered before it was known
            EXPECT_NEAR(row.dtheta_final_arcsec, n == 16 ? parabola(k) : mean, 1e-9);
            EXPECT_EQ(has(row.flags, flag_unrepaired), n == 17);
            EXPECT_EQ(has(row.flags, flag_interpolated), n == 16);
            EXPECT_EQ(std::isinf(row.sigma_arcsec), n == 17);
        }
        EXPECT_EQ(std::isinf(got.gaps.at(0).sigma_sum_arcsec), n == 17);
    }
}

// However long a gap, its first 16 ticks were delivered with something else than their final value.
TEST(GapBridge, TheCorrectionOfAGapThatIsTooLongIsOfItsFirstSixteenTicks) {
    for (const int n : {17, 40, 48, 56, 57, 64, 65, 100, 1000}) {
        const Delivered got = run(config_of(BridgeMethod::quadratic), log_of(n + 60, 20, n, parabola));
        const double mean = (parabola(16) + parabola(17) + parabola(18) + parabola(19)) / 4.0;
        double lump = 0.0;
        for (int k = 20; k < 36; ++k) lump += mean - parabola(k);
        const int due = 20 + n + 2;
        EXPECT_NEAR(got.rows[static_cast<unsigned>(due)].dtheta_arcsec, parabola(due) + lump, 1e-8) << "gap of " << n;
        EXPECT_NEAR(got.gaps.at(0).dp_arcsec, -lump, 1e-8) << "gap of " << n;
    }
}

TEST(GapBridge, ALogWithoutAMeasuredTickIsZeroOfUnknownSigma) {
    for (const std::size_t n : {1u, 5u, 16u, 17u, 200u}) {
        const Delivered got = run(config_of(BridgeMethod::quadratic), Log(n, gap_tick()));
        ASSERT_EQ(got.rows.size(), n);
        for (const AngleRow& row : got.rows) {
            EXPECT_EQ(row.dtheta_arcsec, 0.0);
            EXPECT_EQ(row.dtheta_final_arcsec, 0.0);
            EXPECT_TRUE(std::isinf(row.sigma_arcsec));
            EXPECT_TRUE(has(row.flags, flag_unrepaired));
        }
    }
}

}  // namespace zlg::core::gap_bridge_support::gap_bridge_test
