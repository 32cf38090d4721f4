// The sigma that the bridge states, against a free-running counter that truncates a motion of random phase.
#include "gap_bridge_support.hpp"

namespace zlg::core::gap_bridge_support::noise_test {

constexpr int n_trials = 5'000;  // the scatter of a sigma is then 1 %
constexpr double tolerance = 0.1;
constexpr double count_arcsec = 3.263;

struct Case {
    BridgeMethod method = BridgeMethod::quadratic;
    int gap_ticks = 3;
    int points_before = 2;
    int points_after = 2;
    double walk_arcsec = 0.0;  // white angle noise of one tick
};

struct Scatter {
    Statistics sum;     // error of the gap's final angle
    Statistics middle;  // error of its middle tick
    double sigma_sum = 0.0;
    double sigma_middle = 0.0;
};

// Angle at the end of tick k: a polynomial, so that the rate of every tick is of the order of the bridge.
struct Motion {
    double phase_counts;
    double rate;
    double acceleration;
    double jerk;

    double counts_at(int k) const { return phase_counts + k * (rate + k * (acceleration + k * jerk)); }
};

Motion random_motion(Random& random, int order) {
    return {random.uniform(0.0, 1.0), random.uniform(-40.0, 40.0), order >= 1 ? random.uniform(-0.5, 0.5) : 0.0,
            order >= 2 ? random.uniform(-0.05, 0.05) : 0.0};
}

Log counted(Random& random, const Motion& motion, const Case& c, int first) {
    Log log;
    for (int k = 0; k < first + c.gap_ticks + 12; ++k) {
        const double counts = std::floor(motion.counts_at(k + 1)) - std::floor(motion.counts_at(k));
        TickInput tick = k >= first && k < first + c.gap_ticks ? gap_tick() : measured_tick(count_arcsec * counts);
        tick.value_arcsec += c.walk_arcsec * random.normal();
        tick.variance_arcsec2 = count_arcsec * count_arcsec / 6.0 + c.walk_arcsec * c.walk_arcsec;
        log.push_back(tick);
    }
    return log;
}

Scatter scatter_of(const Case& c) {
    Random random{11};
    const GapBridgeConfig config{.method = c.method, .points_before = c.points_before, .points_after = c.points_after};
    const int first = 10;
    const int middle = first + c.gap_ticks / 2;
    Scatter scatter;
    for (int trial = 0; trial < n_trials; ++trial) {
        const Motion motion = random_motion(random, order_of(c.method));
        const Delivered got = run(config, counted(random, motion, c, first), {.scale = Arcsec{count_arcsec}});
        const auto true_arcsec = [&](int from, int to) {
            return count_arcsec * (motion.counts_at(to) - motion.counts_at(from));
        };
        double sum = 0.0;
        for (int k = first; k < first + c.gap_ticks; ++k) sum += got.rows[static_cast<unsigned>(k)].dtheta_final_arcsec;
        const AngleRow& row = got.rows[static_cast<unsigned>(middle)];
        scatter.sum.add(sum - true_arcsec(first, first + c.gap_ticks));
        scatter.middle.add(row.dtheta_final_arcsec - true_arcsec(middle, middle + 1));
        scatter.sigma_sum = got.gaps.at(0).sigma_sum_arcsec;
        scatter.sigma_middle = row.sigma_arcsec;
    }
    return scatter;
}

void expect_stated_sigma(const Case& c) {
    const Scatter scatter = scatter_of(c);
    const double sum = std::sqrt(scatter.sum.variance());
    const double middle = std::sqrt(scatter.middle.variance());
    EXPECT_NEAR(scatter.sigma_sum / sum, 1.0, tolerance)
        << "method " << static_cast<int>(c.method) << " n " << c.gap_ticks;
    EXPECT_NEAR(scatter.sigma_middle / middle, 1.0, tolerance)
        << "method " << static_cast<int>(c.method) << " n " << c.gap_ticks;
    EXPECT_NEAR(scatter.sum.mean(), 0.0, 5.0 * sum / std::sqrt(1.0 * n_trials));
}

// For other points, too, and with the random walk.
TEST(GapBridgeNoise, SigmaIsThatOfADifferencedRounding) {
    for (const auto method : {BridgeMethod::constant, BridgeMethod::linear, BridgeMethod::quadratic}) {
        for (const int gap_ticks : {1, 3, 6, 16}) expect_stated_sigma({.method = method, .gap_ticks = gap_ticks});
        expect_stated_sigma({.method = method, .walk_arcsec = 5.0});
    }
    expect_stated_sigma({.points_before = 4, .points_after = 1});
    expect_stated_sigma({.points_before = 1, .points_after = 4});
    expect_stated_sigma({.points_before = 8, .points_after = 8});
    expect_stated_sigma({.method = BridgeMethod::linear, .points_before = 1, .points_after = 1});
}

// Equal noise without a shared rounding: the factors that the weights alone give.
TEST(GapBridgeNoise, WithoutRoundingTheFactorsAreThoseOfTheWeights) {
    for (const auto& [method, factor] : {std::pair{BridgeMethod::constant, 1.5},
                                         {BridgeMethod::linear, 1.5},
                                         {BridgeMethod::quadratic, std::sqrt(14.5)}}) {
        Log log(30, measured_tick(1.0));
        for (TickInput& tick : log) tick.variance_arcsec2 = 4.0;
        for (unsigned k = 10; k < 13; ++k) log[k] = gap_tick();
        const Delivered got = run({.method = method}, log, {.scale = Arcsec{0.0}});
        EXPECT_NEAR(got.gaps.at(0).sigma_sum_arcsec, 2.0 * factor, 1e-12);
    }
}

// Each of four points has a quarter of a line over the gap, by symmetry, and the error of a correction behind the gap
// stays there, too.
TEST(GapBridgeNoise, TheErrorOfARelockIsInTheGapAndBehindIt) {
    constexpr double relock_arcsec2 = 0.7;
    const GapBridgeConfig config{.method = BridgeMethod::linear, .points_before = 2, .points_after = 2};
    for (const int n : {1, 3, 8}) {
        std::array<double, 2> variance{};
        for (const bool corrected : {false, true}) {
            Log log;
            for (int k = 0; k < 40; ++k) {
                TickInput tick = k >= 10 && k < 10 + n ? gap_tick() : measured_tick(0.0);
                tick.variance_arcsec2 = 4.0;
                if (corrected && k >= 10 + n) {
                    tick.variance_arcsec2 += relock_arcsec2;
                    tick.relock_variance_arcsec2 = relock_arcsec2;
                }
                log.push_back(tick);
            }
            const Delivered got = run(config, log, {.scale = Arcsec{0.0}});
            variance[corrected] = std::pow(got.gaps.at(0).sigma_sum_arcsec, 2.0);
        }
        EXPECT_NEAR(variance[1] - variance[0], 2.0 * std::pow(0.25 * n + 1.0, 2.0) * relock_arcsec2, 1e-9) << n;
    }
}

// In another unit of the angle every choice is the same, and every sigma but for the unit: no number of arcseconds
// decides.
TEST(GapBridgeNoise, TheSizeOfACountChangesNoChoice) {
    constexpr double smaller = 1.0 / 1024.0;
    const auto rows_of = [&](double unit) {
        Random random{5};
        const double scale = unit * count_arcsec;
        double turned = 0.0, rate = 0.0;
        Log log;
        for (int k = 0; k < 6000; ++k) {
            // A walk, at last ever smoother.
            rate += (k < 2000 ? 0.3 : 0.0) * random.normal() + 0.05 * std::cos(0.002 * k) - 0.002 * rate;
            const double before = std::floor(turned);
            turned += rate;
            TickInput tick = k > 20 && k % 40 < 3 ? gap_tick() : measured_tick(scale * (std::floor(turned) - before));
            tick.variance_arcsec2 = scale * scale / 6.0;
            log.push_back(tick);
        }
        return run({.method = BridgeMethod::automatic}, log,
                   {.scale = Arcsec{scale}, .random_walk = zlg::core::ArcsecPerRootSecond{0.14 * unit}})
            .rows;
    };
    const std::vector<AngleRow> large = rows_of(1.0), small = rows_of(smaller);
    ASSERT_EQ(large.size(), small.size());
    for (std::size_t k = 0; k < large.size(); ++k)
        EXPECT_NEAR(small[k].sigma_arcsec / smaller, large[k].sigma_arcsec, 1e-6 * large[k].sigma_arcsec) << k;
}

// A polynomial that stands in for an estimate is judged by the motion around the gap: of one tick that is the whole
// gap.
TEST(GapBridgeNoise, SigmaOfAFirstGapOfOneTickIsThatOfItsTick) {
    int n_more = 0;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        Random random{seed};
        Log log;
        for (int k = 0; k < 60; ++k)
            log.push_back(k == 30 ? gap_tick() : measured_tick(count_arcsec * std::floor(random.uniform(0.0, 3.0))));
        const auto sigmas = [&](BridgeMethod method) {
            const Delivered got = run({.method = method}, log, {.scale = Arcsec{count_arcsec}});
            return std::pair{got.rows[30].sigma_arcsec, got.gaps.at(0).sigma_sum_arcsec};
        };
        const auto [of_tick, of_gap] = sigmas(BridgeMethod::automatic);
        EXPECT_NEAR(of_tick, of_gap, 1e-9 * of_gap) << seed;
        n_more += of_gap > 1.01 * sigmas(BridgeMethod::quadratic).second ? 1 : 0;
    }
    EXPECT_GT(n_more, 0);
}

// Of a point, it makes that of the gap unknown; and the straight line through four ticks gives the second of them no
// weight in the first tick of a gap.
TEST(GapBridgeNoise, AnUnknownSigmaSpreadsEvenWhereItsWeightIsZero) {
    Log log = joined({measured(10), gap(3), measured(16), gap(1)});
    log[13].variance_arcsec2 = log[26].variance_arcsec2 = infinite;
    for (const auto method : {BridgeMethod::linear, BridgeMethod::quadratic}) {
        const Delivered got = run({.method = method}, log);
        for (const unsigned k : {10u, 11u, 12u, 29u}) EXPECT_TRUE(std::isinf(got.rows[k].sigma_arcsec)) << k;
        EXPECT_TRUE(std::isinf(got.gaps.at(0).sigma_sum_arcsec));
    }
}

}  // namespace zlg::core::gap_bridge_support::noise_test
