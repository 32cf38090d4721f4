#include <zlg/core/compensation/gap_bridge_state.hpp>

#include <gtest/gtest.h>

#include <cmath>

#include <zlg/core/compensation/gap_bridge.hpp>

#include "compensation/gap/gap_estimate.hpp"
#include "gap_bridge_support.hpp"

namespace gap_bridge_state_test {

using namespace gap_bridge_support;
using compensation_test::Random;
using zlg::core::Arcsec;
using zlg::core::BridgeMethod;
using zlg::core::flag_lower_order;

constexpr CompensationConstants fine{.scale = Arcsec{1.0}};

GapBridgeConfig learning(BridgeMethod method) {
    GapBridgeConfig config;
    config.method = method;
    return config;
}

// A tone of 20.06 Hz, or what `rate` makes of the tick, read by a counter, with a gap of n ticks in every 150.
template <class Angle>
Log counted(int n_ticks, int n_gap, Angle&& angle) {
    Log log;
    for (int t = 0; t < n_ticks; ++t) {
        const double value = std::floor(angle(t + 1)) - std::floor(angle(t));
        TickInput tick = measured_tick(value);
        tick.variance_arcsec2 = 1.0 / 6.0;
        if (t % 150 >= 150 - n_gap) tick.measured = false;
        log.push_back(tick);
    }
    return log;
}

double tone(int edge) { return 95.2 * std::cos(2.0 * 3.141592653589793 * 20.06 * 0.005 * edge); }

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
        const Errors quadratic = errors_of(run(learning(BridgeMethod::quadratic), log, fine), log);
        for (const BridgeMethod method : {BridgeMethod::optimal, BridgeMethod::automatic}) {
            const Errors learnt = errors_of(run(learning(method), log, fine), log);
            EXPECT_LT(learnt.mean_sq, 0.5 * quadratic.mean_sq) << n_gap;
            EXPECT_LT(learnt.mean_sq, 1.0) << n_gap;
            EXPECT_NEAR(learnt.nev, 1.05, 0.45) << n_gap;
        }
    }
}

// The random walk of the re-lock ticks stays in the angle of a switch: in its sigma, and in nothing else.
TEST(LearningBridge, SigmaOfASwitchHoldsTheRandomWalkAfterIt) {
    constexpr double walk_arcsec2 = 0.7;
    for (const BridgeMethod method : {BridgeMethod::quadratic, BridgeMethod::optimal, BridgeMethod::automatic}) {
        const Log log = counted(6000, 3, tone);
        Log walking = log;
        for (TickInput& tick : walking) tick.walk_of_switch_arcsec2 = walk_arcsec2;
        const Delivered without = run(learning(method), log, fine);
        const Delivered with = run(learning(method), walking, fine);
        EXPECT_EQ(with.rows, without.rows);
        ASSERT_EQ(with.gaps.size(), without.gaps.size());
        ASSERT_GT(with.gaps.size(), 30u);
        for (std::size_t k = 0; k < with.gaps.size(); ++k)
            EXPECT_NEAR(std::pow(with.gaps[k].sigma_sum_arcsec, 2.0),
                        std::pow(without.gaps[k].sigma_sum_arcsec, 2.0) + walk_arcsec2, 1e-9);
    }
}

// What is delivered in a gap is a prediction from the ticks before it, with two readings rounded at each point.
TEST(LearningBridge, AToneIsPredictedDuringTheGap) {
    const Log log = counted(12000, 3, tone);
    const auto mean_sq_delivered = [&log](BridgeMethod method) {
        const Delivered got = run(learning(method), log, fine);
        double sum = 0.0;
        int n = 0;
        for (std::size_t t = 3000; t < log.size(); ++t) {
            if (log[t].measured) continue;
            const double error = got.rows[t].dtheta_arcsec - log[t].value_arcsec;
            sum += error * error;
            ++n;
        }
        return sum / n;
    };
    const double quadratic = mean_sq_delivered(BridgeMethod::quadratic);
    for (const BridgeMethod method : {BridgeMethod::optimal, BridgeMethod::automatic}) {
        EXPECT_LT(mean_sq_delivered(method), 0.1 * quadratic);
        EXPECT_LT(mean_sq_delivered(method), 1.0);
    }
}

TEST(LearningBridge, SumsAreEqualWhateverTheLog) {
    Random random{10};
    for (int trial = 0; trial < 60; ++trial) {
        Log log = random_log(random, random.index(1, 900));
        // The last corrections are due within 24 ticks, in a measured one.
        for (int k = 0; k < 40; ++k) log.push_back(measured_tick(random.uniform(-60.0, 60.0)));
        GapBridgeConfig config = learning(random.chance(0.5) ? BridgeMethod::optimal : BridgeMethod::automatic);
        config.optimal.halves = random.chance(0.3);
        const Delivered got = run(config, log, fine);
        ASSERT_EQ(got.rows.size(), log.size());
        long double difference = 0.0L;
        for (const AngleRow& row : got.rows)
            difference +=
                static_cast<long double>(row.dtheta_final_arcsec) - static_cast<long double>(row.dtheta_arcsec);
        EXPECT_NEAR(static_cast<double>(difference), 0.0, 1e-9) << trial;
    }
}

TEST(LearningBridge, AnEstimateThatIsInTimeIsTheSame) {
    for (int n_gap = 1; n_gap <= 15; ++n_gap) {
        GapBridgeConfig config = learning(BridgeMethod::automatic);
        config.optimal.halves = n_gap % 2 == 0;
        const Log log = counted(2500, n_gap, tone);
        GapBridgeState hurried;
        GapBridgeState plain;
        for (const TickInput& tick : log) {
            // Twice a tick, as its two halves do, and more often.
            advance_estimate(fine, config, plain);
            for (int k = 0; k < 3; ++k) advance_estimate(fine, config, hurried);
            const AngleSample a = step(fine, config, hurried, tick);
            const AngleSample b = step(fine, config, plain, tick);
            ASSERT_EQ(a.dtheta_arcsec, b.dtheta_arcsec) << a.tick;
            ASSERT_EQ(a.final_row, b.final_row) << a.tick;
            ASSERT_EQ(a.gap, b.gap) << a.tick;
        }
    }
}

TEST(LearningBridge, ShortHistoryIsBridgedByThePolynomialAndSaysSo) {
    const Log log = counted(140, 0, [](int edge) { return 3.0 * edge; });
    Log early = log;
    for (std::size_t t = 60; t < 63; ++t) early[t].measured = false;
    for (const BridgeMethod method : {BridgeMethod::optimal, BridgeMethod::automatic}) {
        const Delivered got = run(learning(method), early, fine);
        ASSERT_EQ(got.gaps.size(), 1u);
        for (std::size_t t = 60; t < 63; ++t) {
            EXPECT_TRUE(got.rows[t].flags & flag_lower_order);
            EXPECT_NEAR(got.rows[t].dtheta_final_arcsec, 3.0, 1e-9);
        }
    }
}

TEST(LearningBridge, AJourneyThatBeginsAfterRestIsNotBridgedAsRest) {
    // Rest for 9000 ticks, then an oscillation that was never seen before: no worse than 1.1 times the parabola.
    const auto angle_at = [](int edge) {
        return edge < 9000 ? 0.0213 * edge : 0.0213 * edge + tone(edge) - tone(9000);
    };
    const Log log = counted(12000, 3, angle_at);
    const Errors quadratic = errors_of(run(learning(BridgeMethod::quadratic), log, fine), log);
    const Errors automatic = errors_of(run(learning(BridgeMethod::automatic), log, fine), log);
    EXPECT_LT(automatic.mean_sq, 1.21 * quadratic.mean_sq);
    EXPECT_LT(automatic.nev, 3.0);
}

// Rest, then a ramp of the rate, and a gap in it. In the angle of the gap the errors of its ticks may cancel; each row must
// do without that, and what is claimed of the rows must allow for what is claimed of their sum.
TEST(LearningBridge, TicksOfARampAreWithinTheirSigma) {
    struct Ramp {
        int n_ticks, n_ramp;
        double slope;
    };
    for (const auto& [n_ticks, n_ramp, slope] :
         {Ramp{1050, 300, 8.0}, Ramp{1050, 300, -60.0}, Ramp{3000, 20, 0.5}, Ramp{6000, 20, 2.0}}) {
        const int start = n_ticks - n_ramp;
        const auto ramp = [start, slope = slope](int edge) {
            const double since = std::fmax(0.0, edge - start);
            return 0.0213 * edge + 0.5 * slope * since * since;
        };
        const Log log = counted(n_ticks + 60, 3, ramp);
        const Delivered got = run(learning(BridgeMethod::automatic), log, fine);
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

TEST(LearningBridge, AStateIsAPlainValue) {
    Random random{12};
    const GapBridgeConfig config = learning(BridgeMethod::automatic);
    const Log log = random_log(random, 1500);
    GapBridgeState state;
    for (std::size_t t = 0; t < 700; ++t) (void)step(fine, config, state, log[t]);
    GapBridgeState copy = state;
    EXPECT_EQ(copy, state);
    for (std::size_t t = 700; t < log.size(); ++t) {
        ASSERT_EQ(step(fine, config, state, log[t]).dtheta_arcsec, step(fine, config, copy, log[t]).dtheta_arcsec);
    }
    EXPECT_EQ(copy, state);
    EXPECT_LT(sizeof(GapBridgeState), 44u * 1024u);
}

// False angles of 1 + d times what is presumed, of which the scale has learnt a part: d after one switch.
double learnt_scale(double d, double before) {
    constexpr std::int64_t n_before = 20, n_gap = 2;
    GapBridgeConfig config = learning(BridgeMethod::optimal);
    config.optimal = {.learns = false, .halves = true};
    config.optimal.prior_arcsec2[0] = 1.0;
    GapBridgeState state;
    state.bias_scale.value = before;
    state.joint = {.first_tick = n_before + n_gap, .known = true};
    Delivered result;
    for (std::int64_t t = 0; t < n_before + n_gap + 20; ++t) {
        TickInput tick = t >= n_before && t < n_before + n_gap ? gap_tick() : measured_tick(10.0);
        for (std::int64_t h = 0; h < 2; ++h) {
            const std::int64_t k = 2 * (t - state.joint.first_tick) + h;
            if (k < 0 || k >= zlg::core::profile_halves) continue;
            double& correction = state.joint.correction_arcsec[static_cast<std::size_t>(k)];
            correction = (h == 0 ? 1000.0 : -1000.0) * std::exp(-0.3 * static_cast<double>(k));
            tick.value_arcsec -= (1.0 + d) * correction;
            tick.half_excess_arcsec -= (h == 0 ? 1.0 : -1.0) * (1.0 + d) * correction;
        }
        for (int half = 0; half < 2; ++half) advance_estimate(fine, config, state);
        step_into(config, state, tick, result, fine);
    }
    return state.bias_scale.value;
}

// What is left of the false angles is (d - learnt) times what is presumed, whatever is learnt: the points and their
// covariance are the same, and so must be the step.
TEST(LearningBridge, ASwitchTeachesTheScaleOfTheBiasAsMuchWhateverIsLearntOfIt) {
    const double first = learnt_scale(0.01, 0.0);
    EXPECT_NEAR(first, 0.01, 0.0002);
    for (const double before : {-0.08, 0.05, 0.08})
        EXPECT_NEAR(learnt_scale(before + 0.01, before) - before, first, 1e-9) << before;
}

// In a re-lock the halves before a gap hold a bias that still grows: the gap is bridged by whole ticks.
TEST(LearningBridge, HalvesOfTicksInARelockAreNoPoints) {
    constexpr std::int64_t n_before = 20, n_gap = 2;
    const auto angle = [](double excess_arcsec, std::int64_t settled_tick) {
        GapBridgeConfig config = learning(BridgeMethod::optimal);
        config.optimal = {.learns = false, .halves = true};
        for (std::size_t k = 0; k < config.optimal.prior_arcsec2.size(); ++k)
            config.optimal.prior_arcsec2[k] = std::exp(-0.3 * static_cast<double>(k));
        GapBridgeState state;
        state.joint = {.first_tick = n_before + n_gap, .known = true};
        Delivered result;
        for (std::int64_t t = 0; t < n_before + n_gap + 20; ++t) {
            TickInput tick = t >= n_before && t < n_before + n_gap ? gap_tick() : measured_tick(10.0);
            tick.settled_tick = settled_tick;
            if (t < n_before)
                tick.half_excess_arcsec = excess_arcsec * std::exp(0.5 * static_cast<double>(t - n_before));
            for (int half = 0; half < 2; ++half) advance_estimate(fine, config, state);
            step_into(config, state, tick, result, fine);
        }
        drain_into(config, state, result, fine);
        return result.rows[n_before].dtheta_final_arcsec + result.rows[n_before + 1].dtheta_final_arcsec;
    };
    EXPECT_GT(std::abs(angle(5.0, 0) - angle(0.0, 0)), 0.1);
    EXPECT_EQ(angle(5.0, n_before), angle(0.0, n_before));
}

// One profile is held: that of the gap that waits, not one of a gap that is resolved.
TEST(GapBridgeStateTest, NeedsAProfileWhileItsGapWaits) {
    GapBridgeState state;
    state.joint.first_tick = 7;
    EXPECT_FALSE(needs_profile(state));
    state.n_pending = 2;
    state.pending[0].gap.first_tick = 5;
    state.pending[0].gap.n = 2;
    state.pending[1].gap.first_tick = 20;
    state.pending[1].gap.n = 3;
    EXPECT_TRUE(needs_profile(state));
    state.joint.first_tick = 23;
    EXPECT_TRUE(needs_profile(state));
    state.joint.first_tick = 8;
    EXPECT_FALSE(needs_profile(state));
    state.joint.first_tick = 7;
    state.pending[0].resolved = true;
    EXPECT_FALSE(needs_profile(state));
}

// To weigh the judgement of a motion takes as much as to estimate a gap: it waits while a gap lasts or is not yet resolved.
TEST(LearningBridge, WeightsOfAMotionWaitUntilNoGapDoes) {
    const GapBridgeConfig config = learning(BridgeMethod::automatic);
    GapBridgeState state;
    Delivered result;
    Random random{31};
    const auto due = [&state] { return state.learning.moments.n_folded != state.learning.n_weighed; };
    const auto measure = [&] {
        step_into(config, state, measured_tick(10.0 + random.uniform(-2.0, 2.0)), result, fine);
    };
    for (int k = 0; k < 400 && !due(); ++k) measure();
    ASSERT_TRUE(due());
    for (int k = 0; k < 5; ++k) step_into(config, state, gap_tick(), result, fine);
    EXPECT_TRUE(due()) << "weighed within the gap";
    for (int k = 0; k < 100 && result.gaps.empty(); ++k) {
        measure();
        EXPECT_TRUE(due()) << "weighed " << k << " ticks after the gap, which was not resolved";
    }
    ASSERT_FALSE(result.gaps.empty());
    for (int k = 0; k < 100 && due(); ++k) measure();
    EXPECT_FALSE(due());
}

}  // namespace gap_bridge_state_test
