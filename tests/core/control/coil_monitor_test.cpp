#include <zlg/core/control/coil_monitor.hpp>

#include "support.hpp"

namespace zlg::core::coil_monitor_test {

constexpr MonitorLimits config{.coil_ratio = 0.0033};

// 1 A with the noise of a converter, by default 0.1 %.
class Coil {
public:
    double positive = 1.0;
    double negative = 1.0;
    double noise = 1e-3;

    explicit Coil(int halves = 0) { (void)n_off(halves); }
    void set(double both) { positive = negative = both; }

    CoilMonitorOutput half() {
        sign_ = -sign_;
        const double now_a = sign_ * (sign_ > 0 ? positive : negative) + noise * normal_(random_);
        return step(config, state, sign_, now_a);
    }
    int n_off(int n) { return count(n, &CoilMonitorOutput::off); }
    int n_unbalanced(int n) { return count(n, &CoilMonitorOutput::unbalanced); }

    CoilMonitorState state;

private:
    int count(int n, bool CoilMonitorOutput::*what) {
        int found = 0;
        for (int k = 0; k < n; ++k) found += half().*what;
        return found;
    }

    int sign_ = -1;
    std::mt19937 random_{7};
    std::normal_distribution<double> normal_;
};

TEST(CoilMonitor, AnOrdinaryCurrentIsNeverOff) {
    for (const double noise : {0.0, 1e-3, 1e-2}) {
        Coil coil;
        coil.noise = noise;
        EXPECT_EQ(coil.n_off(200000), 0) << noise;
    }
}

// A supply that ages by a tenth within two hours of halves, 30 times what is tolerated at once.
TEST(CoilMonitor, ACurrentThatDriftsIsFollowed) {
    Coil coil{500};
    int off = 0;
    for (int k = 0; k < 300000; ++k) {
        coil.set(1.0 + 0.1 * k / 300000.0);
        off += coil.half().off;
    }
    EXPECT_EQ(off, 0);
    EXPECT_NEAR(coil.state.level_a[0], 1.1, 0.003);
    EXPECT_NEAR(coil.state.level_a[1], 1.1, 0.003);
}

// The mean size of a normal deviation is sqrt(2/pi) of its standard deviation.
TEST(CoilMonitor, TheSpreadThatItLearnsIsThatOfTheReadings) {
    for (const double noise : {1e-4, 1e-3, 1e-2}) {
        Coil coil;
        coil.noise = noise;
        (void)coil.n_off(200);  // it follows by then, with weights that change little
        EXPECT_NEAR(coil.state.spread / noise, 0.798, 0.2) << noise;
    }
}

TEST(CoilMonitor, ACurrentThatIsNotMeasuredSaysNothing) {
    CoilMonitorState s;
    for (int k = 0; k < 1000; ++k) {
        const CoilMonitorOutput out = step(config, s, k % 2 == 0 ? 1 : -1, k % 3 == 0 ? not_a_number : 0.0);
        ASSERT_FALSE(out.off || out.unbalanced);
    }
    for (int k = 0; k < 1000; ++k) ASSERT_FALSE(step({}, s, 1, k % 2 == 0 ? 1.0 : 3.0).off);
}

TEST(CoilMonitor, AHalfPerCentOfAsymmetryIsSeenWithinTenHalves) {
    Coil coil{500};
    coil.positive = 1.005;
    coil.negative = 0.995;
    int k = 0;
    while (!coil.half().unbalanced) ASSERT_LT(++k, 10);
    EXPECT_GE(coil.n_unbalanced(2000), 1990);
    coil.set(1.0);
    (void)coil.n_off(40);
    EXPECT_EQ(coil.n_off(1000), 0);
}

// Ten per cent are, two per cent that stay are still.
TEST(CoilMonitor, AnAsymmetryIsSeenAtOnceAndIsNoNewLevel) {
    for (const auto& [positive, halves] : {std::pair{0.9, 0}, {1.02, 5000}}) {
        Coil coil{500};
        coil.positive = positive;
        (void)coil.n_off(halves);
        EXPECT_EQ(coil.n_unbalanced(100), 100) << positive;
    }
}

// In absolute terms: no history tells what the signs should be.
TEST(CoilMonitor, AnAsymmetryFromTheStartIsSeenAtOnceAndTeachesNothing) {
    for (const double part : {0.008, 0.01, 0.02, 0.07, 0.2, 1.0, -0.07}) {
        for (const double noise : {0.0, 1e-3}) {
            Coil coil;
            coil.noise = noise;
            coil.positive = 1.0 + part;
            coil.negative = 1.0 - part;
            const int late = std::abs(part) > 0.03 ? 1 : (std::abs(part) < 0.01 ? 30 : 8);
            EXPECT_GE(coil.n_unbalanced(1200), 1200 - late) << part << ", noise " << noise;
            coil.set(1.0);
            (void)coil.n_off(200);
            EXPECT_EQ(coil.n_off(3000), 0) << part << ", noise " << noise;
        }
    }
}

TEST(CoilMonitor, SignsThatGrowApartAreNotFollowedBeyondOnePerCent) {
    Coil coil{500};
    int k = 0;
    for (; k < 300000 && !coil.half().unbalanced; ++k) coil.positive = 1.0 + 0.1 * k / 300000.0;
    EXPECT_NEAR(coil.positive, 1.01, 0.002);
    EXPECT_EQ(coil.n_unbalanced(1000), 1000);
}

// The angle of a tick holds the difference of its halves only.
TEST(CoilMonitor, ALossInBothSignsIsOffButUnbalancedOnlyWhereItBegins) {
    Coil coil{500};
    coil.set(0.5);
    EXPECT_TRUE(coil.half().unbalanced);
    EXPECT_EQ(coil.n_unbalanced(300), 0);
    EXPECT_TRUE(coil.half().off);
}

TEST(CoilMonitor, ALossInBothSignsThatStaysIsTheNewLevel) {
    Coil coil{500};
    coil.set(0.9);
    (void)coil.n_off(450);
    EXPECT_EQ(coil.n_off(1000), 0);
    EXPECT_NEAR(coil.state.level_a[0], 0.9, 2e-3);
}

// Whatever the noise, however much was lost, and for however long.
TEST(CoilMonitor, ACurrentThatComesBackIsTheOldOneAtOnce) {
    for (const double left : {0.0, 0.01, 0.05, 0.1, 0.3, 0.45}) {
        for (const int halves : {10, 600, 24000}) {
            Coil coil{500};
            coil.set(left);
            EXPECT_EQ(coil.n_off(halves), halves) << left;
            coil.set(1.0);
            (void)coil.n_off(60);
            EXPECT_EQ(coil.n_off(5000), 0) << left << " of the current for " << halves;
        }
    }
}

// A level that was learnt while the supply was faulty is not kept when it is mended.
TEST(CoilMonitor, LevelsLearntOfAFaultyCurrentAreGivenUp) {
    struct Learnt {
        double positive, negative;
    };
    for (const Learnt learnt : {Learnt{0.3, 0.3}, Learnt{0.03, 0.03}, Learnt{1.08, 0.92}, Learnt{0.99, 1.01}}) {
        Coil coil;
        coil.positive = learnt.positive;
        coil.negative = learnt.negative;
        (void)coil.n_off(500);
        coil.set(1.0);
        (void)coil.n_off(1000);
        EXPECT_EQ(coil.n_off(5000), 0) << learnt.positive << " and " << learnt.negative;
        EXPECT_NEAR(coil.state.spread, 0.8e-3, 0.2e-3);
        coil.positive = 1.01;
        coil.negative = 0.99;
        (void)coil.n_off(20);
        EXPECT_EQ(coil.n_unbalanced(1000), 1000);
    }
}

// A converter that read another current for a while has taught nothing that lasts.
TEST(CoilMonitor, ACurrentThatWasReadTooHighIsTheOldOneAgain) {
    for (const double read : {1.5, 1.9, 2.5, 4.0, 30.0}) {
        for (const int times : {1, 2}) {
            Coil coil{500};
            for (int k = 1; k <= times; ++k) {
                coil.set(std::pow(read, k));
                (void)coil.n_off(1000);
            }
            coil.set(1.0);
            (void)coil.n_off(1000);
            EXPECT_EQ(coil.n_off(5000), 0) << read << ", " << times;
            coil.positive = 1.05;
            (void)coil.n_off(20);
            EXPECT_EQ(coil.n_unbalanced(100), 100) << read << ", " << times;
        }
    }
}

}  // namespace zlg::core::coil_monitor_test
