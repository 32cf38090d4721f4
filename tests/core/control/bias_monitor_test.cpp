#include <zlg/core/control/bias_monitor.hpp>

#include "support.hpp"

namespace zlg::core::bias_monitor_test {

constexpr MonitorLimits config{.bias_counts = 150.0};

// A counter that rounds down, under a bias and a rotation given in counts per half.
class Counter {
public:
    double bias = 150.0;
    double rate = 0.0;
    bool settled = true;

    explicit Counter(int halves = 0) { (void)after(halves); }

    BiasMonitorOutput half(const MonitorLimits& c = config) {
        sign_ = static_cast<std::int8_t>(-sign_);
        phase_ += rate + sign_ * bias;
        const auto now = static_cast<std::int64_t>(std::floor(phase_));
        const std::int64_t counts = now - last_;
        last_ = now;
        return step(c, state, true, static_cast<double>(counts), sign_, settled);
    }
    // The last of n halves; with a bias that it keeps.
    BiasMonitorOutput after(int n) {
        BiasMonitorOutput out;
        for (int k = 0; k < n; ++k) out = half();
        return out;
    }
    BiasMonitorOutput after(int n, double new_bias) {
        bias = new_bias;
        return after(n);
    }

    BiasMonitorState state;

private:
    std::int8_t sign_ = -1;
    double phase_ = 0.3;
    std::int64_t last_ = 0;
};

TEST(BiasMonitor, LearnsTheBiasThatIsThereWhateverWasPresumed) {
    for (const double bias : {60.0, 150.0, 400.0}) {
        Counter counter;
        (void)counter.after(200, bias);
        EXPECT_NEAR(counter.state.bias_counts, bias, 0.5);
        const BiasMonitorOutput out = counter.half();
        EXPECT_TRUE(out.judged && out.in_band);
        EXPECT_FALSE(out.reversed || out.lost || out.near_rate);
    }
}

TEST(BiasMonitor, JudgesNothingWithoutABiasToTell) {
    Counter counter;
    counter.bias = 20.0;
    for (int k = 0; k < 300; ++k) EXPECT_FALSE(counter.half({.bias_counts = 20.0}).judged);
    Counter off;
    for (int k = 0; k < 300; ++k) EXPECT_FALSE(off.half({}).judged);
}

TEST(BiasMonitor, NoOrdinaryRotationLeavesTheBand) {
    for (const double frequency_hz : {0.3, 7.03, 20.06, 100.3}) {
        Counter counter{100};
        for (int k = 0; k < 20000; ++k) {
            counter.rate = 12000.0 * 0.0025 / 3.263 * std::sin(2.0 * 3.14159265 * frequency_hz * 0.0025 * k);
            ASSERT_TRUE(counter.half().in_band) << frequency_hz << " Hz, half " << k;
        }
    }
}

TEST(BiasMonitor, RotationAtTheHighestRateLeavesTheBiasInItsBand) {
    Counter counter;
    for (int k = 0; k < 4000; ++k) {
        counter.rate = 1100.0 * std::sin(1e-3 * k);  // 400 deg/s
        const BiasMonitorOutput out = counter.half();
        ASSERT_TRUE(out.in_band || !out.judged) << k;
    }
}

TEST(BiasMonitor, AGlitchIsSeenInItsHalf) {
    for (const double glitch : {-150.0, -40.0, 40.0, 150.0}) {
        Counter counter{100};
        counter.rate = glitch;
        EXPECT_FALSE(counter.half().in_band) << glitch;
        counter.rate = 0.0;
        EXPECT_TRUE(counter.after(4).in_band) << glitch;
    }
}

TEST(BiasMonitor, TheOtherHelicityIsKnownAfterFourHalves) {
    Counter counter{100};
    // The first half of the other sign beside one of the old is no bias at all.
    EXPECT_TRUE(counter.after(1, -150.0).lost);
    for (int k = 0; k < 3; ++k) {
        const BiasMonitorOutput out = counter.half();
        EXPECT_FALSE(out.in_band || out.reversed) << k;
    }
    EXPECT_TRUE(counter.half().reversed);
    EXPECT_FALSE(counter.after(1, 150.0).reversed);
    EXPECT_TRUE(counter.after(3).in_band);
    EXPECT_NEAR(counter.state.bias_counts, 150.0, 0.5);
}

TEST(BiasMonitor, ALostBiasIsNotLearntAndReturns) {
    Counter counter{100};
    (void)counter.after(2, 0.0);
    for (int k = 0; k < 5000; ++k) {
        const BiasMonitorOutput out = counter.half();
        ASSERT_TRUE(out.lost && !out.in_band && !out.reversed);
    }
    EXPECT_TRUE(counter.after(4, 150.0).in_band);
}

// Learnt while the current was faulty: what is presumed tells the better level from the worse one.
TEST(BiasMonitor, ABiasThatWasLearntOfAFaultIsGivenUp) {
    for (const double part : {0.4, 0.7, 1.3}) {
        Counter counter;
        (void)counter.after(500, 150.0 * part);
        EXPECT_NEAR(counter.state.bias_counts, 150.0 * part, 0.5);
        (void)counter.after(50, 150.0);
        for (int k = 0; k < 1000; ++k) ASSERT_TRUE(counter.half().in_band) << part << ", half " << k;
        EXPECT_NEAR(counter.state.bias_counts, 150.0, 0.5);
    }
}

TEST(BiasMonitor, AChangeForGoodIsLearntAfterASecondAndNotBefore) {
    Counter counter{500};
    counter.bias = 120.0;
    for (int k = 0; k < 395; ++k) ASSERT_FALSE(counter.half().in_band);
    (void)counter.after(20);
    for (int k = 0; k < 1000; ++k) ASSERT_TRUE(counter.half().in_band);
    EXPECT_TRUE(counter.after(51, 150.0).in_band) << "the way back is short";
}

// Each half is off by more than a twelfth of the one before: no level, however long it lasts.
TEST(BiasMonitor, ABiasThatSwingsIsNoNewLevel) {
    Counter counter{500};
    for (int k = 0; k < 1000; ++k) {
        (void)counter.after(2, k % 2 == 0 ? 80.0 : 105.0);
        ASSERT_NEAR(counter.state.bias_counts, 150.0, 0.5) << k;
    }
}

// What is learnt is the mean: of the first 32 differences, and of the 400 of a new level.
TEST(BiasMonitor, ALevelIsTheMeanOfWhatItWasLearntOf) {
    Counter counter{1};
    const auto jitter = [&counter](double level, int halves) {
        for (int k = 0; k < halves; k += 4) (void)counter.after(4, k % 8 == 0 ? level - 4.0 : level + 4.0);
    };
    jitter(150.0, 32);
    EXPECT_EQ(counter.state.n_learnt, 32);
    EXPECT_NEAR(counter.state.bias_counts, 150.0, 1.0);
    jitter(100.0, 408);
    EXPECT_NEAR(counter.state.bias_counts, 100.0, 1.0);
}

TEST(BiasMonitor, ABiasThatWasNeverThereIsLost) {
    Counter counter;
    const BiasMonitorOutput out = counter.after(101, 0.0);
    EXPECT_TRUE(out.lost);
    EXPECT_FALSE(out.judged);
}

TEST(BiasMonitor, OnTheWayToALockTheBiasMayLackAThird) {
    Counter counter{100};
    counter.settled = false;
    EXPECT_TRUE(counter.after(3, 110.0).in_band);
    EXPECT_FALSE(counter.after(3, 60.0).in_band);
}

TEST(BiasMonitor, TheDeficitIsWhatTheBiasLacks) {
    Counter counter{1000};
    EXPECT_NEAR(counter.after(4, 147.0).deficit_ratio, 0.02, 0.01);
}

TEST(BiasMonitor, ARotationThatCancelsTheBiasIsTheLockInZone) {
    Counter counter{100};
    counter.rate = 148.0;
    (void)counter.after(3);
    EXPECT_NE(counter.half().near_rate, counter.half().near_rate);
    counter.rate = 130.0;
    EXPECT_FALSE(counter.after(5).near_rate || counter.half().near_rate);
}

TEST(BiasMonitor, HalvesThatWereNotCountedBreakTheRow) {
    Counter counter{100};
    EXPECT_FALSE(step(config, counter.state, false, 0, 1, false).judged);
    EXPECT_FALSE(counter.half().judged);
    EXPECT_TRUE(counter.half().judged);
    const auto most = static_cast<double>(std::numeric_limits<std::int64_t>::min());
    EXPECT_FALSE(step(config, counter.state, true, most, 1, false).judged);
}

}  // namespace zlg::core::bias_monitor_test
