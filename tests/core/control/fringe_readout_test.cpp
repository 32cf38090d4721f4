#include <zlg/core/control/fringe_readout.hpp>

#include "support.hpp"

namespace zlg::core::fringe_readout_test {

constexpr double tau = 2.0 * std::numbers::pi;
constexpr FringeReadoutConfig config{.reads = true, .limit = 1.9};
static_assert(is_allowed(config));
static_assert(!is_allowed(FringeReadoutConfig{.counts_per_turn = 2}));
static_assert(!is_allowed(FringeReadoutConfig{.amplitude = 0.0}));
static_assert(!is_allowed(FringeReadoutConfig{.limit = 0.0}));
static_assert(!is_allowed(FringeReadoutConfig{.noise_turns = -1.0}));
static_assert(!is_allowed(FringeReadoutConfig{.lag_turns = 0.2}));
static_assert(!is_allowed(FringeReadoutConfig{.max_skew_turns = not_a_number}));
static_assert(!is_allowed(FringeReadoutConfig{.turned_back_turns = -1.0}));

// Electronics of a beat at a known phase: an ellipse, noise, a counter whose comparators lag by some turns.
struct Electronics {
    FringeReadoutConfig c = config;
    FringeReadoutState state;
    double noise = 0.01;
    double lag_turns = 0.0;          // the counter shows this much less
    double skew_turns = 0.0;         // the samples show this much less in the sense of the beat
    double rotation_counts = 0.0;    // of a tick
    double turned_back_turns = 0.0;  // by such a rotation, in halves whose beat it runs against
    std::int64_t half = 0;
    std::mt19937_64 engine{3};
    std::normal_distribution<double> normal{};

    FringeReadoutInput input(double turns) {
        const int sign = half % 2 == 0 ? 1 : -1;
        const double seen = turns - sign * skew_turns;
        const double back = static_cast<double>(sign) * rotation_counts < 0.0 ? turned_back_turns : 0.0;
        const double behind = std::max(lag_turns - back, -lag_turns);
        const double quarters = std::floor(4.0 * (turns - sign * behind));
        const auto shown = static_cast<std::int64_t>(c.counts_per_turn == 4 ? quarters : std::floor(quarters / 4.0));
        return {.present = true,
                .c = static_cast<float>(0.05 + 1.05 * std::cos(tau * seen) + noise * normal(engine)),
                .s = static_cast<float>(-0.04 + 0.97 * std::sin(tau * seen + 0.08) + noise * normal(engine)),
                .quarter = static_cast<std::uint32_t>(static_cast<std::int64_t>(quarters) & 3),
                .counter = static_cast<std::uint64_t>(shown),
                .settled = true,
                .sign = sign,
                .rotation_counts = rotation_counts};
    }
    FringeReadoutOutput read(const FringeReadoutInput& in) {
        ++half;
        return step(c, state, in);
    }
    FringeReadoutOutput at(double turns) { return read(input(turns)); }

    // It has learnt the ellipse.
    static Electronics learnt() {
        Electronics e;
        e.learn();
        return e;
    }
    void learn() {
        for (int k = 0; k < 800; ++k) (void)at(k * 37.6180339887);
        ASSERT_TRUE(state.ellipse.learnt);
    }
};

double place(const FringeReadoutOutput& out) {
    return static_cast<double>(static_cast<std::int64_t>(out.counter)) + out.fringe / 65536.0;
}

TEST(FringeReadout, WithoutItTheCountIsAsItWasRead) {
    Electronics e;
    e.c.reads = false;
    const FringeReadoutOutput out = e.at(-7.3);
    EXPECT_EQ(out.counter, static_cast<std::uint64_t>(-8));
    EXPECT_TRUE(std::isnan(out.fringe));
    EXPECT_EQ(e.state, FringeReadoutState{});
}

TEST(FringeReadout, CountAndPhaseAreOneNumberOnEitherSideOfABorder) {
    for (const int counts : {1, 4}) {
        for (const double lag : {0.0, 0.016, 0.1}) {
            Electronics e;
            e.c.counts_per_turn = counts;
            e.lag_turns = lag;
            e.learn();
            for (int k = -2000; k < 2000; ++k) {
                // Through the borders of all quarters, forth and back, in steps of the noise.
                const double turns = 5e5 * (k % 7) + k * 0.00153;
                const FringeReadoutOutput out = e.at(turns);
                ASSERT_GE(out.fringe, 0.0f) << turns;
                ASSERT_LT(out.fringe, 65536.0f);
                EXPECT_NEAR(place(out) / counts, turns, 0.012) << turns << " " << lag;
            }
        }
    }
}

TEST(FringeReadout, AnythingBadInOneSampleCostsThisSampleAlone) {
    Electronics e = Electronics::learnt();
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    constexpr float inf = std::numeric_limits<float>::infinity();
    for (const float bad : {nan, inf, -inf, 2.0f, -1.95f}) {
        for (const bool second : {false, true}) {
            FringeReadoutInput in = e.input(1000.25);
            (second ? in.s : in.c) = bad;
            const FringeReadoutOutput out = e.read(in);
            EXPECT_TRUE(std::isnan(out.fringe));
            EXPECT_EQ(out.counter, in.counter);
            for (int k = 0; k < 20; ++k) EXPECT_GE(e.at(1000.25 + 13.7 * k).fringe, 0) << k;
        }
    }
    FringeReadoutInput in = e.input(1000.3);
    in.present = false;
    EXPECT_TRUE(std::isnan(e.read(in).fringe));
    EXPECT_GE(e.at(1000.3).fringe, 0);
}

TEST(FringeReadout, ADeadPhotodiodeIsSeenWithinATickAndCostsNoFringe) {
    for (const float shown : {0.0f, 0.3f}) {
        for (const bool noisy : {false, true}) {
            for (const bool second : {false, true}) {
                Electronics e = Electronics::learnt();
                int n_wrong = 0;
                for (int k = 0; k < 400; ++k) {
                    const double turns = 500.0 + k * 11.381966;
                    FringeReadoutInput in = e.input(turns);
                    (second ? in.s : in.c) = shown + (noisy ? 0.01f * static_cast<float>(e.normal(e.engine)) : 0.0f);
                    const FringeReadoutOutput out = e.read(in);
                    if (std::isnan(out.fringe)) {
                        EXPECT_EQ(out.counter, in.counter);
                        continue;
                    }
                    ++n_wrong;
                    EXPECT_LT(std::abs(place(out) - turns), 0.5);
                }
                EXPECT_LE(n_wrong, 2);
            }
        }
    }
}

TEST(FringeReadout, BothStuckAreSeenByTheComparators) {
    Electronics e = Electronics::learnt();
    const FringeReadoutInput first = e.input(70.1);
    int n_read = 0;
    for (int k = 0; k < 200; ++k) {
        FringeReadoutInput in = e.input(70.1 + 5.3 * k);
        in.c = first.c;
        in.s = first.s;
        n_read += e.read(in).fringe >= 0;
    }
    EXPECT_LE(n_read, 2);
}

// Once they were seen to be stuck they are, also while the comparators stand still.
TEST(FringeReadout, BothStuckStayUnreadUntilTheyMove) {
    Electronics e = Electronics::learnt();
    FringeReadoutInput in = e.input(70.1);
    EXPECT_GE(e.read(in).fringe, 0);
    in.quarter = (in.quarter + 1) & 3;
    EXPECT_TRUE(std::isnan(e.read(in).fringe));
    for (int k = 0; k < 5; ++k) EXPECT_TRUE(std::isnan(e.read(in).fringe)) << k;
    EXPECT_GE(e.at(71.3).fringe, 0);
}

TEST(FringeReadout, NoiseFarBeyondThePresumedOneIsNotRead) {
    Electronics e = Electronics::learnt();
    e.noise = 0.2;
    int n_read = 0;
    for (int k = 0; k < 400; ++k) n_read += e.at(k * 3.7).fringe >= 0;
    EXPECT_LE(n_read, 10);
    e.noise = 0.01;
    for (int k = 0; k < 300; ++k) (void)e.at(k * 3.7);
    EXPECT_GE(e.at(8.2).fringe, 0);
}

// Twice the amplitude by a new lamp, and other offsets: learnt anew.
TEST(FringeReadout, PhotodiodesThatChangedForGoodAreLearntAnew) {
    Electronics e = Electronics::learnt();
    bool read = false;
    for (int k = 0; k < 4000; ++k) {
        FringeReadoutInput in = e.input(k * 3.7123);
        in.c = 0.6f * in.c + 0.3f;
        const FringeReadoutOutput out = e.read(in);
        read = out.fringe >= 0;
        if (read) EXPECT_NEAR(place(out), k * 3.7123, 0.1);
    }
    EXPECT_TRUE(read);
}

TEST(FringeReadout, OnceLearntItIsReadAtRest) {
    Electronics turned = Electronics::learnt();
    for (int k = 0; k < 3000; ++k) EXPECT_GE(turned.at(k % 2 == 0 ? 150.2 : 0.2).fringe, 0);
}

// After a gap it is so in its last lit halves.
TEST(FringeReadout, ACounterThatLostQuartersIsJoinedAnew) {
    for (const bool settled : {true, false}) {
        Electronics e = Electronics::learnt();
        int n_lost = 0;
        double offset = 0.0;
        for (int k = 0; k < 200; ++k) {
            const double turns = k * 3.7123;
            FringeReadoutInput in = e.input(turns + 0.5);  // the counter is half a turn ahead of the photodiodes
            const FringeReadoutInput seen = e.input(turns);
            in.c = seen.c;
            in.s = seen.s;
            in.settled = settled;
            const FringeReadoutOutput out = e.read(in);
            n_lost += std::isnan(out.fringe);
            if (out.fringe >= 0) offset = place(out) - turns;
        }
        EXPECT_LE(n_lost, settled ? 9 : 1);
        EXPECT_NEAR(offset, 0.5, 0.012);
    }
}

void expect_skew(Electronics& e, double skew) {
    e.skew_turns = skew;
    e.learn();
    bool skewed = false;
    for (int k = 0; k < 20'000; ++k) skewed = e.at(k * 37.6180339887).skewed;
    EXPECT_EQ(skewed, skew > 0.003) << skew;
    EXPECT_NEAR(e.state.skew_turns, -skew, 0.0015);
}

TEST(FringeReadout, ASkewBetweenLatchAndSamplingIsReported) {
    for (const double lag : {0.0, 0.016}) {
        for (const double skew : {0.0, 0.0012, 0.0048, 0.03}) {
            SCOPED_TRACE(lag);
            Electronics e;
            e.c.lag_turns = e.lag_turns = lag;
            expect_skew(e, skew);
        }
    }
}

// A rotation of 100 counts a half lets the beat turn back by 0.02 turns before every other latch; one of 300 by more
// than the comparators follow. Unknown, it would be a skew of half of that.
TEST(FringeReadout, ARotationThatTurnsTheBeatBackIsNoSkew) {
    for (const double counts : {200.0, -200.0, 600.0}) {
        for (const double skew : {0.0, 0.006}) {
            Electronics e;
            e.c.lag_turns = e.lag_turns = 0.02;
            e.c.turned_back_turns = 2e-6;
            e.rotation_counts = counts;
            e.turned_back_turns = 2e-6 * 0.25 * counts * counts;
            SCOPED_TRACE(counts);
            expect_skew(e, skew);
        }
    }
}

// At rest the same places come again and again, here all on one side of the middle of their octant.
TEST(FringeReadout, PlacesThatRepeatAreNoSkew) {
    Electronics e = Electronics::learnt();
    bool skewed = false;
    for (std::int64_t k = 0; k < 20'000; ++k) {
        const double side = k % 2 == 0 ? 0.04 : -0.04;
        skewed = skewed || e.at(0.125 * static_cast<double>(k / 2 % 8) + 0.0625 + side).skewed;
    }
    EXPECT_FALSE(skewed);
    EXPECT_GE(e.state.n_skews, 16);
    EXPECT_NEAR(e.state.skew_turns, 0.0, 0.001);
}

// A turn in 2500 halves: the first samples of every other octant are those in which the comparators lag.
TEST(FringeReadout, APhaseThatCreepsTellsNoSkew) {
    Electronics e = Electronics::learnt();
    e.c.lag_turns = e.lag_turns = 0.016;
    bool skewed = false;
    for (std::int64_t k = 0; k < 60'000; ++k) skewed = skewed || e.at(4e-4 * static_cast<double>(k)).skewed;
    EXPECT_FALSE(skewed);
}

}  // namespace zlg::core::fringe_readout_test
