#include <zlg/core/compensation/gap_bridge_state.hpp>

#include "gap_bridge_support.hpp"

namespace zlg::core::gap_bridge_support::state_test {

constexpr CompensationConstants fine{.scale = Arcsec{1.0}};

struct Errors {
    double mean_sq = 0.0, nev = 0.0;
    int n = 0;
};

// Errors of the angles of the gaps from tick 3000 on.
Errors errors_of(const Delivered& got, const Log& log) {
    Errors e;
    for (const GapReport& gap : got.gaps) {
        if (gap.first_tick < 3000) continue;
        double error = 0.0;
        for (std::int64_t t = gap.first_tick; t < gap.first_tick + gap.n_ticks; ++t) {
            const auto k = static_cast<std::size_t>(t);
            error += got.rows[k].dtheta_final_arcsec - log[k].value_arcsec;
        }
        ++e.n;
        e.mean_sq += error * error;
        e.nev += error * error / (gap.sigma_sum_arcsec * gap.sigma_sum_arcsec);
    }
    e.mean_sq /= e.n;
    e.nev /= e.n;
    return e;
}

TEST(LearningBridge, AToneIsLearntAndItsSigmaIsTrue) {
    for (const int n_gap : {1, 3, 9}) {
        const Log log = counted(24000, n_gap, tone);
        const Errors quadratic = errors_of(run({.method = BridgeMethod::quadratic}, log, fine), log);
        const Errors learnt = errors_of(run({.method = BridgeMethod::automatic}, log, fine), log);
        EXPECT_LT(learnt.mean_sq, 0.5 * quadratic.mean_sq) << n_gap;
        EXPECT_LT(learnt.mean_sq, 0.5) << n_gap;
        EXPECT_NEAR(learnt.nev, 0.8, 0.55) << n_gap;
    }
}

// The random walk of the re-lock ticks stays in the angle of a switch: in its sigma, and in nothing else.
TEST(LearningBridge, SigmaOfASwitchHoldsTheRandomWalkAfterIt) {
    const double walk_arcsec2 = 20.0 * 0.14 * 0.14 * 0.005;
    for (const BridgeMethod method : {BridgeMethod::quadratic, BridgeMethod::automatic}) {
        const Log log = counted(6000, 3, tone);
        const Delivered without = run({.method = method}, log, fine);
        const Delivered with = run({.method = method, .relock_ticks = 20}, log, fine);
        EXPECT_EQ(with.rows, without.rows);
        ASSERT_EQ(with.gaps.size(), without.gaps.size());
        ASSERT_GT(with.gaps.size(), 30u);
        for (std::size_t k = 0; k < with.gaps.size(); ++k)
            EXPECT_NEAR(std::pow(with.gaps[k].sigma_sum_arcsec, 2.0),
                        std::pow(without.gaps[k].sigma_sum_arcsec, 2.0) + walk_arcsec2, 1e-9);
    }
}

TEST(LearningBridge, SumsAreEqualWhateverTheLog) {
    Random random{10};
    for (int trial = 0; trial < 60; ++trial) {
        Log log = random_log(random, random.index(1, 900));
        // The last corrections are due within 24 ticks, in a measured one.
        for (int k = 0; k < 40; ++k) log.push_back(measured_tick(random.uniform(-60.0, 60.0)));
        const GapBridgeConfig config{.method = BridgeMethod::automatic};
        const Delivered got = run(config, log, fine);
        ASSERT_EQ(got.rows.size(), log.size());
        long double difference = 0.0L;
        for (const AngleRow& row : got.rows)
            difference +=
                static_cast<long double>(row.dtheta_final_arcsec) - static_cast<long double>(row.dtheta_arcsec);
        EXPECT_NEAR(static_cast<double>(difference), 0.0, 1e-9) << trial;
    }
}

TEST(LearningBridge, AnEstimateWithoutALearntMotionSaysSo) {
    const Log log = counted(60, 0, [](double edge) { return 3.0 * edge; });
    Log early = log;
    for (std::size_t t = 20; t < 23; ++t) early[t].measured = false;
    const Delivered got = run({.method = BridgeMethod::automatic}, early, fine);
    ASSERT_EQ(got.gaps.size(), 1u);
    for (std::size_t t = 20; t < 23; ++t) {
        EXPECT_TRUE(got.rows[t].flags & flag_lower_order);
        EXPECT_NEAR(got.rows[t].dtheta_final_arcsec, 3.0, 3.0 * got.rows[t].sigma_arcsec);
    }
}

TEST(LearningBridge, AJourneyThatBeginsAfterRestIsNotBridgedAsRest) {
    // Rest for 9000 ticks, then an oscillation that was never seen before: no worse than 1.1 times the parabola.
    const auto angle_at = [](double edge) {
        return edge < 9000 ? 0.0213 * edge : 0.0213 * edge + tone(edge) - tone(9000);
    };
    const Log log = counted(12000, 3, angle_at);
    const Errors quadratic = errors_of(run({.method = BridgeMethod::quadratic}, log, fine), log);
    const Errors automatic = errors_of(run({.method = BridgeMethod::automatic}, log, fine), log);
    EXPECT_LT(automatic.mean_sq, 1.21 * quadratic.mean_sq);
    EXPECT_LT(automatic.nev, 3.0);
}

// Rest, then a ramp of the rate, and a gap in it. In the angle of the gap the errors of its ticks may cancel; each row
// must do without that, and what is claimed of the rows must allow for what is claimed of their sum.
TEST(LearningBridge, TicksOfARampAreWithinTheirSigma) {
    struct Ramp {
        int n_ticks, n_ramp;
        double slope;
    };
    for (const auto& [n_ticks, n_ramp, slope] :
         {Ramp{1050, 300, 8.0}, Ramp{1050, 300, -60.0}, Ramp{3000, 20, 0.5}, Ramp{6000, 20, 2.0}}) {
        const int start = n_ticks - n_ramp;
        const auto ramp = [start, slope = slope](double edge) {
            const double since = std::fmax(0.0, edge - start);
            return 0.0213 * edge + 0.5 * slope * since * since;
        };
        const Log log = counted(n_ticks + 60, 3, ramp);
        const Delivered got = run({.method = BridgeMethod::automatic}, log, fine);
        const GapReport& gap = got.gaps.back();
        ASSERT_EQ(gap.first_tick, n_ticks - 3);
        double sum_of_sigmas = 0.0;
        for (auto t = static_cast<std::size_t>(gap.first_tick); t < static_cast<std::size_t>(n_ticks); ++t) {
            const AngleRow& row = got.rows[t];
            EXPECT_NEAR(row.dtheta_final_arcsec, log[t].value_arcsec, 5.0 * row.sigma_arcsec) << slope;
            sum_of_sigmas += row.sigma_arcsec;
        }
        EXPECT_GE(sum_of_sigmas, 0.99 * gap.sigma_sum_arcsec) << slope;
    }
}

}  // namespace zlg::core::gap_bridge_support::state_test
