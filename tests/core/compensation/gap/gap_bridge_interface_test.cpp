// How the bridge is drained, and what it does with a tick that becomes final one tick later.
#include "gap_bridge_support.hpp"

namespace zlg::core::gap_bridge_support::interface_test {

TEST(GapBridgeInterface, TheDelayIsThatOfTheLongestGapAndOfThePointsAfterIt) {
    for (int ahead = 3; ahead <= 8; ++ahead)
        for (int after = 1; after <= 8; ++after) {
            const GapBridgeConfig config{.extrapolation_points = ahead, .points_after = after};
            const int delay = final_delay_ticks({}, config);
            EXPECT_EQ(delay, 16 + (ahead > after ? ahead : after));
            EXPECT_LE(delay, 24);
        }
}

TEST(GapBridgeInterface, DrainGivesTheRestOnceAndThenNothing) {
    for (const std::size_t n : {0u, 1u, 5u, 20u, 21u, 100u}) {
        const Delivered got = run({}, Log(n, measured_tick(1.0)));
        EXPECT_EQ(got.rows.size(), n);
    }
    GapBridgeState state;
    (void)step({}, GapBridgeConfig{}, state, measured_tick(1.0));
    EXPECT_TRUE(drain({}, GapBridgeConfig{}, state).has_row);
    for (int k = 0; k < 3; ++k) EXPECT_FALSE(drain({}, GapBridgeConfig{}, state).has_row);
}

TEST(GapBridgeInterface, MeasuredTicksPassUntouched) {
    Random random{2};
    Log log;
    for (int k = 0; k < 100; ++k) {
        TickInput tick = measured_tick(random.uniform(-60.0, 60.0));
        tick.variance_arcsec2 = random.uniform(0.0, 4.0);
        tick.relock_arcsec = random.uniform(-1.0, 1.0);
        tick.flags = flag_relock_corrected;
        log.push_back(tick);
    }
    const Delivered got = run({}, log);
    for (std::size_t k = 0; k < log.size(); ++k) {
        EXPECT_EQ(got.rows[k].dtheta_arcsec, log[k].value_arcsec);
        EXPECT_EQ(got.rows[k].dtheta_final_arcsec, log[k].value_arcsec);
        EXPECT_EQ(got.rows[k].sigma_arcsec, std::sqrt(log[k].variance_arcsec2));
        EXPECT_EQ(got.rows[k].relock_arcsec, log[k].relock_arcsec);
        EXPECT_EQ(got.rows[k].flags, flag_relock_corrected);
    }
}

TEST(GapBridgeInterface, SwitchingIsSaidFromTheTickThatHasTheNewHelicity) {
    Log log(30, measured_tick(1.0));
    log[10] = gap_tick(1);
    log[11] = log[12] = gap_tick(-1);
    for (std::size_t k = 13; k < log.size(); ++k) log[k].mode = -1;
    log[20] = gap_tick(-1);  // a drop-out without a switch
    const Delivered got = run({}, log);
    for (std::size_t k = 0; k < log.size(); ++k)
        EXPECT_EQ(has(got.rows[k].flags, flag_switching), k == 11 || k == 12) << k;
    EXPECT_TRUE(got.gaps.at(0).mode_changed);
    EXPECT_FALSE(got.gaps.at(1).mode_changed);
}

// The first tick after a gap is delivered with what is known of it, and becomes final one tick later.
TEST(GapBridgeInterface, AnAmendedTickIsFinalInEveryFitAndPaidBackByTheLump) {
    for (const auto method : {BridgeMethod::none, BridgeMethod::quadratic}) {
        const GapBridgeConfig config{.method = method};
        Log log(30, measured_tick(5.0));
        for (unsigned k = 10; k < 13; ++k) log[k] = gap_tick();
        const Delivered plain = run(config, log);
        log[13].value_arcsec = 45.0;  // 40 of it are false
        log[14].amend_previous = true;
        log[14].amend_arcsec = -40.0;
        log[14].amend_variance_arcsec2 = 0.45;
        log[14].amend_flags = flag_relock_corrected;
        const Delivered got = run(config, log);
        EXPECT_EQ(got.rows[13].dtheta_arcsec, 45.0);
        EXPECT_EQ(got.rows[13].dtheta_final_arcsec, 5.0);
        EXPECT_EQ(got.rows[13].relock_arcsec, 40.0);
        EXPECT_DOUBLE_EQ(got.rows[13].sigma_arcsec, std::sqrt(1.8 + 0.45));
        EXPECT_TRUE(has(got.rows[13].flags, flag_relock_corrected));
        EXPECT_TRUE(has(got.rows[15].flags, flag_correction));
        EXPECT_NEAR(got.rows[15].dtheta_arcsec, plain.rows[15].dtheta_arcsec - 40.0, 1e-12);
        for (unsigned k = 10; k < 13; ++k)
            EXPECT_EQ(got.rows[k].dtheta_final_arcsec, plain.rows[k].dtheta_final_arcsec);
        EXPECT_NEAR(got.gaps.at(0).dp_arcsec, plain.gaps.at(0).dp_arcsec, 1e-12);
    }
}

}  // namespace zlg::core::gap_bridge_support::interface_test
