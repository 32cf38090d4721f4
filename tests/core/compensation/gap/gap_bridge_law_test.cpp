// Laws of the bridge on random logs: against a reference that sees the whole log, and against itself.
#include "gap_bridge_reference.hpp"
#include "gap_bridge_support.hpp"

namespace zlg::core::gap_bridge_support::law_test {

using gap_bridge_reference::Reference;

constexpr int n_logs = 400;

Reference reference_of(const GapBridgeConfig& config, const Log& log) {
    std::vector<gap_bridge_reference::Tick> ticks(log.size());
    for (std::size_t k = 0; k < log.size(); ++k) {
        ticks[k].measured = log[k].measured;
        ticks[k].value = log[k].value_arcsec;
        if (log[k].amend_previous) ticks[k - 1].amend = log[k].amend_arcsec;
    }
    return {config, std::move(ticks)};
}

// Lost figures of a long reach ahead from few points: the weights go up to some hundreds.
double tolerance_of(long double expected) { return 1e-10 * (10.0 + std::fabs(static_cast<double>(expected))); }

void expect_flags(const AngleRow& row, const gap_bridge_reference::Tick& tick) {
    EXPECT_EQ(has(row.flags, flag_correction), tick.correction);
    EXPECT_EQ(has(row.flags, flag_extrapolated), tick.extrapolated);
    EXPECT_EQ(has(row.flags, flag_interpolated), tick.interpolated);
    EXPECT_EQ(has(row.flags, flag_unrepaired), tick.unrepaired);
    EXPECT_TRUE(has(row.flags, flag_lower_order) || !tick.lower_order);
    EXPECT_EQ(std::isinf(row.sigma_arcsec), tick.unrepaired);
}

void expect_reference(const GapBridgeConfig& config, const Log& log) {
    const Delivered got = run(config, log);
    const Reference expected = reference_of(config, log);
    ASSERT_EQ(got.rows.size(), log.size());
    for (std::size_t k = 0; k < log.size(); ++k) {
        const AngleRow& row = got.rows[k];
        const auto& tick = expected.ticks[k];
        ASSERT_EQ(row.tick, static_cast<std::int64_t>(k));
        ASSERT_EQ(row.mode, log[k].mode);
        ASSERT_NEAR(row.dtheta_arcsec, static_cast<double>(tick.dtheta), tolerance_of(tick.dtheta)) << k;
        ASSERT_NEAR(row.dtheta_final_arcsec, static_cast<double>(tick.final_value), tolerance_of(tick.final_value))
            << k;
        ASSERT_EQ(got.samples[k].dtheta_arcsec, row.dtheta_arcsec);
        if (config.method != BridgeMethod::none) expect_flags(row, tick);
        ASSERT_FALSE(testing::Test::HasFailure()) << "tick " << k;
    }
}

void expect_reports(const GapBridgeConfig& config, const Log& log) {
    const Delivered got = run(config, log);
    std::size_t next = 0;
    for (const auto& gap : reference_of(config, log).gaps) {
        const auto after = static_cast<std::size_t>(gap.last + 1);
        if (gap.first == 0 || after == log.size()) continue;
        ASSERT_LT(next, got.gaps.size());
        const GapReport& report = got.gaps[next++];
        EXPECT_EQ(report.first_tick, gap.first);
        EXPECT_EQ(report.n_ticks, gap.last - gap.first + 1);
        EXPECT_EQ(report.mode_after, log[after].mode);
        EXPECT_EQ(report.sign_after, log[after].sign);
        EXPECT_EQ(report.mode_changed, log[after].mode != log[static_cast<std::size_t>(gap.first - 1)].mode);
        EXPECT_EQ(std::isinf(report.sigma_sum_arcsec), report.n_ticks > 16 || config.method == BridgeMethod::none);
        EXPECT_NEAR(report.dp_arcsec, static_cast<double>(gap.dp), 16.0 * tolerance_of(gap.dp));
        ASSERT_FALSE(testing::Test::HasFailure()) << "gap " << gap.first << ".." << gap.last;
    }
    EXPECT_EQ(next, got.gaps.size());
}

TEST(GapBridgeLaw, EveryRowIsThatOfTheReference) {
    Random random{1};
    for (int trial = 0; trial < n_logs && !HasFailure(); ++trial) {
        const GapBridgeConfig config = random_config(random);
        expect_reference(config, random_log(random, random.index(1, 400)));
    }
}

TEST(GapBridgeLaw, EveryGapBetweenMeasuredTicksIsReportedOnceAndInOrder) {
    Random random{2};
    for (int trial = 0; trial < n_logs && !HasFailure(); ++trial) {
        const GapBridgeConfig config = random_config(random);
        expect_reports(config, random_log(random, 300));
    }
}

TEST(GapBridgeLaw, SumsAgreeAfterEveryCorrection) {
    Random random{3};
    std::int64_t corrections = 0;
    for (int trial = 0; trial < 8; ++trial) {
        const GapBridgeConfig config = random_config(random);
        const Log log = random_log(random, 100'000);
        const Delivered got = run(config, log);
        const Reference expected = reference_of(config, log);
        Quad difference = 0;
        double worst = 0.0;
        for (std::size_t k = 0; k < log.size(); ++k) {
            difference += Quad{got.rows[k].dtheta_arcsec} - Quad{got.rows[k].dtheta_final_arcsec};
            if (!expected.ticks[k].correction || !expected.ticks[k].settled) continue;
            ++corrections;
            worst = std::max(worst, static_cast<double>(magnitude(difference)));
            // However many there were before: no more is left than the rounding of the correction itself.
            const double rounding = 0x1p-53 * std::fabs(got.rows[k].dtheta_arcsec) + 1e-20;
            ASSERT_LE(static_cast<double>(magnitude(difference)), rounding) << "log " << trial << " tick " << k;
        }
        EXPECT_LE(worst, 1e-9) << "log " << trial;
    }
    EXPECT_GT(corrections, 10'000);
}

// What left the bridge as final is compared with what a later state still holds of that tick.
TEST(GapBridgeLaw, NothingOfARowChangesAfterTheDelay) {
    Random random{4};
    for (int trial = 0; trial < 100; ++trial) {
        const GapBridgeConfig config = random_config(random);
        const Log log = random_log(random, 300);
        GapBridgeState state;
        Delivered got;
        for (const TickInput& tick : log) {
            step_into(config, state, tick, got);
            const std::size_t held = std::min<std::size_t>(
                got.rows.size(), history_ticks - static_cast<unsigned>(final_delay_ticks({}, config)));
            for (std::size_t k = got.rows.size() - held; k < got.rows.size(); ++k)
                ASSERT_EQ(state.history[k % history_ticks].row, got.rows[k]) << "tick " << k;
        }
    }
}

TEST(GapBridgeLaw, RowsOfALogThatWasCutAreThoseOfTheWholeLog) {
    Random random{5};
    for (int trial = 0; trial < 100; ++trial) {
        const GapBridgeConfig config = random_config(random);
        const Log log = random_log(random, 300);
        const Delivered whole = run(config, log);
        const auto cut = static_cast<std::size_t>(random.index(30, 290));
        const Delivered part = run(config, Log(log.begin(), log.begin() + static_cast<std::ptrdiff_t>(cut)));
        ASSERT_EQ(part.rows.size(), cut);
        const auto delay = static_cast<std::size_t>(final_delay_ticks({}, config));
        for (std::size_t k = 0; k < cut; ++k) ASSERT_EQ(part.rows[k].dtheta_arcsec, whole.rows[k].dtheta_arcsec);
        for (std::size_t k = 0; k + delay < cut; ++k)
            ASSERT_EQ(part.rows[k], whole.rows[k]) << "tick " << k << " cut " << cut;
    }
}

// A double-double sum keeps 104 bits, and what a correction has lost as a double waits for the next one: so the two
// sums differ by that residual and nothing else, also where the counter knows the sum over a gap.
TEST(GapBridgeLaw, SumsDifferByTheRoundingResidualAlone) {
    Random random{5};
    for (int k = 0; k < 200; ++k) {
        const GapBridgeConfig config{.method = random.chance(0.5) ? BridgeMethod::quadratic : BridgeMethod::automatic};
        GapBridgeState state;
        Delivered all;
        for (int gap = 0; gap < 8; ++gap) {
            for (int t = 0; t < 40; ++t) step_into(config, state, measured_tick(random.uniform(-60.0, 60.0)), all);
            const int n = random.index(1, 8);
            for (int t = 0; t < n; ++t) {
                TickInput tick = gap_tick();
                if (t + 1 == n) {
                    tick.known.ticks = n;
                    tick.known.arcsec = random.uniform(-90.0, 90.0);
                    tick.known.variance_arcsec2 = 1.8;
                }
                step_into(config, state, tick, all);
            }
        }
        for (int t = 0; t < 40; ++t) step_into(config, state, measured_tick(random.uniform(-60.0, 60.0)), all);
        drain_into(config, state, all);
        ExactSum difference;
        for (const AngleRow& row : all.rows) {
            difference.add(row.dtheta_final_arcsec);
            difference.add(-row.dtheta_arcsec);
        }
        difference.add(-state.rounding_residual_arcsec.high);
        difference.add(-state.rounding_residual_arcsec.low);
        EXPECT_LT(std::abs(difference.value()), 1e-22);
    }
}

}  // namespace zlg::core::gap_bridge_support::law_test
