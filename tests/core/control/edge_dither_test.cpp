#include <zlg/core/control/edge_dither.hpp>

#include "support.hpp"

namespace zlg::core::edge_dither_test {

const EdgeDitherConfig config;

// Shifts of the reversals that begin and end each half of positive bias, ticks.
struct Edges {
    std::vector<std::int32_t> up;
    std::vector<std::int32_t> down;
    EdgeDitherState state;
};

EdgeDitherConfig always(DitherLaw law) {
    EdgeDitherConfig c;
    c.random_above_arcsec_s = law == DitherLaw::paired ? 1e9 : 0.0;
    c.paired_below_arcsec_s = 0.0;
    return c;
}

// One half of a gyro, of so many counts.
std::int32_t half(const EdgeDitherConfig& c, EdgeDitherState& s, int number, std::int64_t counts, int helicity = 1,
                  bool counted = true) {
    const auto next = static_cast<std::int8_t>(number % 2 == 0 ? -1 : 1);
    return step(c, s, next, {counted, counts, static_cast<std::int8_t>(helicity)});
}

// Runs with `counts` in every half, plus the bias's own; the first periods, in which the law is found, are left out.
Edges run(const EdgeDitherConfig& c, int n_periods, std::int64_t counts = 0) {
    Edges edges;
    for (int i = 0; i < n_periods + 132; ++i) {
        const std::int32_t up = half(c, edges.state, 0, 150 + counts);
        const std::int32_t down = half(c, edges.state, 1, -150 + counts);
        if (i < 132) continue;
        edges.up.push_back(up);
        edges.down.push_back(down);
    }
    return edges;
}

// Mean of cos and sin of the place in the turn: both vanish where it is uniform.
double unevenness(const std::vector<std::int32_t>& ticks, double cycle_ticks) {
    double c = 0.0, s = 0.0;
    for (const std::int32_t t : ticks) {
        c += std::cos(6.283185307179586 * t / cycle_ticks);
        s += std::sin(6.283185307179586 * t / cycle_ticks);
    }
    return std::hypot(c, s) / static_cast<double>(ticks.size());
}

constexpr bool allows(auto change) { return test::allows<EdgeDitherConfig>(change); }
static_assert(allows([](auto&) {}));
static_assert(!allows([](auto& c) { c.cycle_ticks = 0.9; }));
static_assert(!allows([](auto& c) { c.cycle_ticks = not_a_number; }));
static_assert(!allows([](auto& c) { c.tick_s = 0.0; }));
static_assert(!allows([](auto& c) { c.scale_arcsec = not_a_number; }));
static_assert(!allows([](auto& c) { c.rate_periods = 0; }));
static_assert(!allows([](auto& c) { c.random_above_arcsec_s = 39.0; }));
static_assert(!allows([](auto& c) { c.paired_below_arcsec_s = not_a_number; }));

TEST(EdgeDither, PairedPeriodsStandHalfACycleApartAndTheirHalvesAreAQuarterLongerAndShorterInTurn) {
    const Edges e = run(always(DitherLaw::paired), 4000);
    for (std::size_t i = 0; i < e.up.size(); i += 4) {
        EXPECT_EQ(e.up[i], e.up[i + 3]);
        EXPECT_EQ(e.up[i + 1], e.up[i + 2]);
        EXPECT_NEAR(e.up[i + 1] - e.up[i], 0.5 * config.cycle_ticks, 1.0);
    }
    EXPECT_LT(unevenness(e.up, config.cycle_ticks), 0.06);
    int n_longer_first = 0;
    for (std::size_t i = 0; i < e.up.size(); ++i) {
        const std::int32_t swing = e.down[i] - e.up[i];
        EXPECT_NEAR(std::abs(swing), 0.25 * config.cycle_ticks, 1.0);
        if (i % 4 != 0) EXPECT_EQ(swing > 0, e.down[i - 1] < e.up[i - 1]);
        if (i % 4 == 0 && swing > 0) ++n_longer_first;
    }
    EXPECT_NEAR(n_longer_first, 500, 80);  // of 1000 groups, five standard deviations
}

TEST(EdgeDither, RandomShiftsFillTheTurnAndLengthsCancelInPairs) {
    const Edges e = run(always(DitherLaw::random), 4000, 1);
    double correlation = 0.0;
    for (std::size_t i = 0; i + 1 < e.up.size(); i += 2) {
        const std::int32_t first = e.down[i] - e.up[i];
        const std::int32_t second = e.down[i + 1] - e.up[i + 1];
        EXPECT_NEAR(first, -second, 2.0);
        EXPECT_LE(std::abs(first), 0.5 * config.cycle_ticks + 1.0);
        correlation += e.up[i] * e.up[i + 1] / (config.cycle_ticks * config.cycle_ticks / 12.0);
    }
    EXPECT_LT(unevenness(e.up, config.cycle_ticks), 0.05);
    EXPECT_LT(unevenness(e.down, config.cycle_ticks), 0.05);
    EXPECT_LT(std::abs(correlation / 2000.0), 0.11);  // five standard deviations
}

TEST(EdgeDither, NoEdgeMovesByMoreThanACycle) {
    for (const DitherLaw law : {DitherLaw::paired, DitherLaw::random}) {
        const Edges e = run(always(law), 20000, 1);
        const auto largest = [](const std::vector<std::int32_t>& v) {
            const auto [low, high] = std::minmax_element(v.begin(), v.end());
            return std::max(-*low, *high);
        };
        EXPECT_LE(std::max(largest(e.up), largest(e.down)), 1.01 * config.cycle_ticks);
        EXPECT_GT(std::max(largest(e.up), largest(e.down)), 0.95 * config.cycle_ticks);
    }
}

// The bias that halves of other than nominal length leave in the counts does not accumulate.
TEST(EdgeDither, TheDifferenceOfTheHalvesStaysBelowFourCycles) {
    EdgeDitherState s;
    std::int64_t area = 0;
    for (int k = 0; k < 10000; ++k) {
        const int sign = k % 2 == 0 ? 1 : -1;
        area += sign * (s.end_ticks - s.start_ticks);
        EXPECT_EQ(half(config, s, k, 150 * sign + 1), s.end_ticks);
        EXPECT_LE(std::abs(area), 4 * 167);
    }
}

TEST(EdgeDither, TheSameSeedGivesTheSameEdgesAndAnotherOthers) {
    EdgeDitherConfig other = config;
    other.seed = 2;
    const Edges a = run(config, 100), b = run(config, 100), c = run(other, 100);
    EXPECT_EQ(a.up, b.up);
    EXPECT_EQ(a.down, b.down);
    EXPECT_NE(a.up, c.up);
}

// n_fast counts more in each half of a measurement of 128 periods: the rate is 2 K n/T.
DitherLaw after(EdgeDitherState& s, double rate_arcsec_s, int n_measurements, int helicity, bool counted = true) {
    const double per_half = rate_arcsec_s * 0.0025 / 3.263;
    double phase = 0.5;
    for (int k = 0; k < 256 * n_measurements + 8; ++k) {
        const int sign = k % 2 == 0 ? 1 : -1;
        const double length = 150.0 + (s.end_ticks - s.start_ticks) / config.cycle_ticks;
        const double next = phase + per_half + sign * helicity * length;
        const auto counts = static_cast<std::int64_t>(std::floor(next) - std::floor(phase));
        phase = next;
        (void)half(config, s, k, counts, helicity, counted);
    }
    return s.law;
}

TEST(EdgeDither, ChangesItsLawWithHysteresis) {
    for (const int helicity : {1, -1}) {
        for (const double direction : {1.0, -1.0}) {
            EdgeDitherState s;
            EXPECT_EQ(after(s, 0.0, 4, helicity), DitherLaw::paired);
            EXPECT_EQ(after(s, 50.0 * direction, 4, helicity), DitherLaw::paired);
            EXPECT_EQ(after(s, 70.0 * direction, 2, helicity), DitherLaw::random);
            EXPECT_EQ(after(s, 50.0 * direction, 4, helicity), DitherLaw::random);
            EXPECT_EQ(after(s, 30.0 * direction, 2, helicity), DitherLaw::paired);
        }
    }
}

TEST(EdgeDither, CountsThatCannotBeTrustedLeaveTheLawAlone) {
    EdgeDitherState s;
    EXPECT_EQ(after(s, 1e5, 4, 1, false), DitherLaw::paired);
    EXPECT_EQ(after(s, 1e5, 2, 1, true), DitherLaw::random);
    EXPECT_EQ(after(s, 0.0, 4, 1, false), DitherLaw::random);
}

// A change of the helicity within a measurement, with a half that was lost beside it, is not taken for rotation.
TEST(EdgeDither, AChangeOfTheHelicityIsNoRotation) {
    EdgeDitherState s;
    for (int k = 0; k < 256 * 4; ++k) {
        const int helicity = k / 128 % 2 == 0 ? 1 : -1;
        (void)half(config, s, k, 150 * (k % 2 == 0 ? 1 : -1) * helicity, helicity, k % 256 != 128);
        EXPECT_EQ(s.wanted, DitherLaw::paired) << k;
    }
}

TEST(EdgeDither, AnyInputLeavesEdgesThatCanBeObeyed) {
    EdgeDitherState s;
    std::uint64_t x = 1;
    for (int i = 0; i < 100000; ++i) {
        x = x * 6364136223846793005u + 1442695040888963407u;
        const RateReading reading{(x >> 40) % 2 == 0, static_cast<std::int64_t>(x), static_cast<std::int8_t>(x >> 48)};
        ASSERT_LE(std::abs(step(config, s, static_cast<std::int8_t>(x >> 56), reading)), 169);
    }
}

TEST(EdgeDither, ALawThatIsAskedForHoldsFromTheFirstEdgeAtAnyRate) {
    for (const DitherMethod method : {DitherMethod::paired, DitherMethod::random}) {
        for (const double rate_arcsec_s : {0.0, 500.0}) {
            EdgeDitherConfig c = config;
            c.method = method;
            EdgeDitherState s;
            for (int k = 0; k < 2000; ++k) {
                const auto turn = static_cast<std::int64_t>(rate_arcsec_s * 0.0025 / 3.263 * k) -
                                  static_cast<std::int64_t>(rate_arcsec_s * 0.0025 / 3.263 * (k - 1));
                (void)half(c, s, k, 150 * (k % 2 == 0 ? 1 : -1) + turn);
                if (s.period >= 0) {
                    EXPECT_EQ(s.law, method == DitherMethod::paired ? DitherLaw::paired : DitherLaw::random) << k;
                }
            }
        }
    }
}

TEST(EdgeDither, NoMethodMovesNoEdge) {
    EdgeDitherConfig c = config;
    c.method = DitherMethod::none;
    const Edges e = run(c, 100);
    EXPECT_EQ(e.up, std::vector<std::int32_t>(100, 0));
    EXPECT_EQ(e.state, EdgeDitherState{});
}

}  // namespace zlg::core::edge_dither_test
