// Borders of the bridge that random logs do not meet: a state of many years, the last tick of a gap that is not too
// long, amendments where no gap is.
#include "gap_bridge_support.hpp"

namespace zlg::core::gap_bridge_support::edges_test {

// With 4 points the constant has the weights 1/4: the sum of three neighbouring covariances of -count^2/12, twice. A
// line through 3 points, one tick ahead, is (-2/3, 1/3, 4/3): with unequal weights it matters which neighbours are
// meant. Ticks with the phase at both ends among others without share at most what the better one has; exact ticks
// share nothing, whatever a count is.
TEST(GapBridgeEdges, TheSigmaOfAnExtrapolationHoldsTheSharedRounding) {
    const GapBridgeConfig constant{.method = BridgeMethod::constant};
    const GapBridgeConfig linear{.method = BridgeMethod::linear, .extrapolation_points = 3};
    const auto expect = [](const GapBridgeConfig& config, const std::vector<double>& points, double scale, double of) {
        Log log;
        for (const double v : points) log.push_back({{.variance_arcsec2 = v}, 10.0});
        const int n = config.method == BridgeMethod::constant ? 2 : 1;
        const Delivered got = run(config, joined({log, gap(n)}), {.scale = Arcsec{scale}});
        for (std::size_t k = log.size(); k < got.rows.size(); ++k)
            EXPECT_NEAR(got.rows[k].sigma_arcsec, std::sqrt(of), of > 0.0 ? 1e-14 : 0.0);
    };
    expect(constant, {1.8, 1.8, 1.8, 1.8}, 3.0, (4.0 * 1.8 - 3.0 * 2.0 * 9.0 / 12.0) / 16.0);
    expect(linear, {1.8, 1.8, 1.8}, 3.0, (1.8 * (4.0 + 1.0 + 16.0) - 2.0 * (9.0 / 12.0) * (-2.0 + 4.0)) / 9.0);
    expect(constant, {1.8, 0.01, 0.01, 1.8}, 3.0, (2.0 * 1.8 + 2.0 * 0.01 - 3.0 * 0.01) / 16.0);
    for (const double scale : {0.0, 3.0}) expect(constant, {0.0, 0.0, 0.0, 0.0}, scale, 0.0);
}

TEST(GapBridgeEdges, ASwitchAddsItsFlagToThoseOfTheTick) {
    Log log = measured(4);
    log.push_back(gap_tick(-1));
    log.back().flags = flag_loop_unlocked | flag_invalid;
    const Delivered got = run({}, log);
    EXPECT_EQ(got.rows[4].flags, flag_loop_unlocked | flag_invalid | flag_switching | flag_extrapolated);
}

TEST(GapBridgeEdges, AGapAtTheStartIsNoSwitch) {
    const Delivered got = run({}, joined({gap(2), measured(6)}));
    for (const unsigned k : {0u, 1u}) EXPECT_EQ(got.rows[k].flags, flag_extrapolated) << k;
}

TEST(GapBridgeEdges, ALogThatEndsInItsSixteenthTickOfAGapIsExtrapolated) {
    const Delivered got = run({}, joined({measured(4), gap(16)}));
    for (unsigned k = 4; k < 20; ++k) {
        EXPECT_EQ(got.rows[k].flags, flag_extrapolated) << k;
        EXPECT_TRUE(std::isfinite(got.rows[k].sigma_arcsec)) << k;
    }
}

// 2^32 ticks are eight months: the number of a tick in its gap must not come round to 1.
TEST(GapBridgeEdges, AGapOfEightMonthsIsStillTooLong) {
    const GapBridgeConfig config;
    GapBridgeState state;
    Delivered got;
    Log log = joined({measured(3), gap(17)});
    for (unsigned k = 0; k < 3; ++k) log[k].value_arcsec = 100.0 * k;
    for (const TickInput& tick : log) step_into(config, state, tick, got);
    state.gap.gap.n = std::int64_t{1} << 32;
    const AngleSample sample = step({}, config, state, gap_tick());
    EXPECT_EQ(sample.flags & flag_unrepaired, flag_unrepaired);
    EXPECT_EQ(sample.dtheta_arcsec, 100.0);
}

TEST(GapBridgeEdges, WhereNothingIsBridgedNothingIsCorrected) {
    const GapBridgeConfig config{.method = BridgeMethod::none};
    const Delivered got = run(config, joined({measured(4), gap(3), measured(8)}));
    for (const AngleRow& row : got.rows) EXPECT_EQ(row.flags & flag_correction, 0u) << row.tick;
}

TEST(GapBridgeEdges, NothingOfAGapIsLeftInTheListOnceItIsPaid) {
    const GapBridgeConfig config;
    GapBridgeState state;
    Delivered got;
    for (const TickInput& tick : joined({measured(6), gap(2), measured(1), gap(2), measured(9)})) {
        step_into(config, state, tick, got);
    }
    EXPECT_EQ(state.n_pending, 0);
    EXPECT_EQ(state.pending, (std::array<PendingGap, max_pending_gaps>{}));
}

TEST(GapBridgeEdges, ATickMayBeAmendedWhereNoGapIs) {
    Log log = measured(3);
    log[1].amend_previous = true;
    log[1].amend_arcsec = 5.0;
    log[1].amend_variance_arcsec2 = 0.45;
    log[1].amend_flags = flag_relock_corrected;
    const Delivered got = run({}, log);
    EXPECT_EQ(got.rows[0].dtheta_final_arcsec, 15.0);
    EXPECT_EQ(got.rows[0].relock_arcsec, -5.0);
    EXPECT_EQ(got.rows[0].sigma_arcsec, 1.5);
    EXPECT_EQ(got.rows[0].flags, flag_relock_corrected);
    EXPECT_EQ(got.rows[1].dtheta_final_arcsec, 10.0);
}

TEST(GapBridgeEdges, AnAmendedTickKeepsTheVarianceOfItsCorrectionsAsAPartOfTheWhole) {
    Log log = measured(3);
    log[0].relock_variance_arcsec2 = 0.25;
    log[1].amend_previous = true;
    log[1].amend_variance_arcsec2 = 0.45;
    GapBridgeState state;
    Delivered got;
    for (const TickInput& tick : log) step_into({}, state, tick, got);
    EXPECT_EQ(state.history[0].read.relock_variance_arcsec2, 0.25 + 0.45);
    EXPECT_EQ(state.history[0].read.variance_arcsec2, 1.8 + 0.45);
    EXPECT_EQ(state.history[1].read.relock_variance_arcsec2, 0.0);
}

TEST(GapBridgeEdges, BeforeTheFirstTickThereIsNothingToAmend) {
    GapBridgeState state;
    TickInput first = measured_tick(10.0);
    first.amend_previous = true;
    first.amend_arcsec = 5.0;
    (void)step({}, {}, state, first);
    for (unsigned k = 1; k < state.history.size(); ++k) EXPECT_EQ(state.history[k], HistoryTick{}) << k;
}

// Two gaps are open to question at the end of the log: their reports come first, one by one, then the rows.
TEST(GapBridgeEdges, TheDrainGivesOneThingAtATimeAndTheRowsLast) {
    const GapBridgeConfig config{.points_after = 8};
    GapBridgeState state;
    Delivered got;
    for (const TickInput& tick : joined({measured(5), gap(1), measured(1), gap(1), measured(1)})) {
        step_into(config, state, tick, got);
    }
    ASSERT_TRUE(got.gaps.empty() && got.rows.empty());
    for (int k = 0; k < 2; ++k) {
        const DrainOutput out = drain({}, config, state);
        EXPECT_TRUE(out.has_gap);
        EXPECT_FALSE(out.has_row);
    }
    for (int k = 0; k < 9; ++k) {
        const DrainOutput out = drain({}, config, state);
        EXPECT_FALSE(out.has_gap);
        EXPECT_TRUE(out.has_row);
        EXPECT_EQ(out.row.tick, k);
    }
}

TEST(GapBridgeEdges, EqualGapsHaveEqualReportsHoweverManyCameBefore) {
    const Delivered got = run({}, joined({measured(8), gap(3), measured(8), gap(3), measured(8), gap(3), measured(8)}));
    ASSERT_EQ(got.gaps.size(), 3u);
    for (const GapReport& report : got.gaps) EXPECT_EQ(report.sigma_sum_arcsec, got.gaps[0].sigma_sum_arcsec);
}

}  // namespace zlg::core::gap_bridge_support::edges_test
