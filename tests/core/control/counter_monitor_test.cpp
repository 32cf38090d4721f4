#include <zlg/core/control/counter_monitor.hpp>

#include "support.hpp"

namespace zlg::core::counter_monitor_test {

constexpr double pi = 3.14159265358979;

// A counter of a biased gyro; bits of what it shows can be stuck, at 1 or at 0.
class Counter {
public:
    double rate = 0.0;    // counts per half
    double jitter = 0.0;  // counts, of each reading
    double bias = 150.0;  // counts of a half
    std::uint64_t stuck_at_1 = 0, stuck_at_0 = 0;

    bool half() {
        sign_ = -sign_;
        phase_ += rate + sign_ * bias;
        const double shown = std::floor(phase_ + jitter * uniform_(random_));
        const auto true_reading = static_cast<std::uint64_t>(static_cast<std::int64_t>(shown));
        return step(state, true, (true_reading | stuck_at_1) & ~stuck_at_0);
    }
    // Halves until a bit is found stuck; n if none is.
    int until_stuck(int n) {
        for (int k = 0; k < n; ++k) {
            if (half()) return k;
        }
        return n;
    }
    void stick(int bit, bool at_1) { (at_1 ? stuck_at_1 : stuck_at_0) |= std::uint64_t{1} << bit; }
    void release() { stuck_at_1 = stuck_at_0 = 0; }

    CounterMonitorState state;
    double phase_ = 1e6;

private:
    int sign_ = -1;
    std::mt19937 random_{3};
    std::uniform_real_distribution<double> uniform_{-1.0, 1.0};
};

TEST(CounterMonitor, AnEvenRotationHasNoStuckBit) {
    for (const double jitter : {0.0, 1.0}) {
        for (double rate = 0.0; rate < 130.0; rate += 0.25) {
            Counter counter;
            counter.rate = rate + 1e-4;
            counter.jitter = jitter;
            ASSERT_EQ(counter.until_stuck(2000), 2000) << rate << ", jitter " << jitter;
        }
    }
}

TEST(CounterMonitor, ASwingingGyroHasNoStuckBit) {
    for (const double frequency_hz : {0.01, 0.3, 7.03, 20.0, 20.06, 100.0}) {
        for (const double swing : {9.2, 200.0}) {
            Counter counter;
            counter.jitter = 1.0;
            for (int k = 0; k < 20000; ++k) {
                counter.rate = swing * std::sin(2.0 * pi * frequency_hz * 0.0025 * k);
                ASSERT_FALSE(counter.half()) << frequency_hz << " Hz, half " << k;
            }
        }
    }
}

// It comes back to the same readings again and again: some bit has the same value in all of them, by chance.
TEST(CounterMonitor, ASwingOfAFewHalvesHasNoStuckBit) {
    for (int halves = 4; halves <= 40; halves += 2) {
        for (const double swing : {4.0, 9.2, 30.0, 100.0}) {
            for (int start = 0; start < 64; ++start) {
                Counter counter;
                counter.phase_ = 1e6 + 17.3 * start;
                for (int k = 0; k < 600; ++k) {
                    counter.rate = swing * std::sin(2.0 * pi * k / halves + 0.1 * start);
                    ASSERT_FALSE(counter.half()) << swing << " counts, " << halves << " halves, half " << k;
                }
            }
        }
    }
}

// Turns to and fro at random, by steps of every size, of a gyro that was quiet: each of them may look like a bit.
TEST(CounterMonitor, ShocksAndStepsOfTheBiasAreNoStuckBit) {
    std::mt19937 random{7};
    std::uniform_real_distribution<double> uniform{0.0, 1.0};
    for (int gyro = 0; gyro < 300; ++gyro) {
        Counter counter;
        const double even = gyro % 2 == 0 ? 0.0 : 40.0 * uniform(random);
        for (int k = 0; k < 4000; ++k) {
            const bool struck = uniform(random) < 0.02;
            const double size = std::pow(2.0, 1.0 + 7.0 * uniform(random));
            counter.rate = even + (struck ? (uniform(random) < 0.5 ? -size : size) : 0.0);
            if (uniform(random) < 0.005) counter.bias = 150.0 * (1.0 - 0.05 * uniform(random));
            ASSERT_FALSE(counter.half()) << "gyro " << gyro << ", half " << k;
        }
    }
}

// Six times 2^k counts of rotation, each of them up to a half-period of the bit late, and what it takes to begin.
TEST(CounterMonitor, AStuckBitIsFoundAfterSixTimesItsValueOfRotation) {
    for (int bit = 1; bit <= 9; ++bit) {
        for (const bool at_1 : {false, true}) {
            for (const double rate : {0.37, -2.31, 11.17, 37.31}) {
                Counter counter;
                counter.rate = rate;
                ASSERT_EQ(counter.until_stuck(1000), 1000);
                counter.stick(bit, at_1);
                const double counts = std::exp2(bit);
                // A suspicion that does not grow for 400 halves is given up.
                if (2.0 * counts > 400.0 * std::abs(rate)) continue;
                const int most = static_cast<int>(12.0 * counts / std::abs(rate)) + 400;
                EXPECT_LT(counter.until_stuck(most), most) << "bit " << bit << " at " << at_1 << ", rate " << rate;
                EXPECT_EQ(counter.state.stuck, 1u << bit);
            }
        }
    }
}

TEST(CounterMonitor, AStuckBitIsFoundInASlowSwing) {
    for (const int bit : {1, 2, 3, 4}) {
        Counter counter;
        bool found = false;
        for (int k = 0; k < 4000 && !found; ++k) {
            if (k == 2000) counter.stick(bit, true);
            counter.rate = 2.0 * std::sin(2.0 * pi * 0.2 * 0.0025 * k);
            found = counter.half();
            ASSERT_TRUE(!found || k >= 2000);
        }
        EXPECT_TRUE(found) << bit;
    }
}

// A swing, two tones, a vibration of 16 halves: no rotation is even.
TEST(CounterMonitor, AStuckBitIsFoundInAnyMotion) {
    struct Tone {
        double counts, frequency_hz;
    };
    struct Case {
        Tone first, second;
        int most_bit, most_halves;
    };
    for (const Case& c : {Case{{9.2, 7.0}, {0.0, 0.0}, 7, 250}, Case{{6.1, 3.1}, {2.3, 11.3}, 7, 250},
                          Case{{3.1, 24.7}, {0.2, 61.0}, 3, 200}}) {
        for (int bit = 1; bit <= c.most_bit; ++bit) {
            for (const bool at_1 : {false, true}) {
                Counter counter;
                int after = 0;
                for (int k = 0; k < 1000 + c.most_halves && after == 0; ++k) {
                    if (k == 1000) counter.stick(bit, at_1);
                    const double t = 0.0025 * k;
                    counter.rate = 0.01 + c.first.counts * std::sin(2.0 * pi * c.first.frequency_hz * t) +
                                   c.second.counts * std::sin(2.0 * pi * c.second.frequency_hz * t);
                    if (counter.half()) after = k - 999;
                }
                EXPECT_GT(after, 0) << "bit " << bit << " at " << at_1 << ", " << c.first.frequency_hz << " Hz";
                EXPECT_EQ(counter.state.stuck, 1u << bit) << bit;
            }
        }
    }
}

TEST(CounterMonitor, OfTwoStuckBitsOneIsFound) {
    for (const int low : {1, 2}) {
        Counter counter;
        counter.rate = 0.61;
        ASSERT_EQ(counter.until_stuck(1000), 1000);
        counter.stick(low, true);
        counter.stick(low + 4, false);
        EXPECT_LT(counter.until_stuck(2000), 2000) << low;
    }
}

TEST(CounterMonitor, AtRestABitProvesNothingAndDoesNoHarm) {
    for (int bit = 1; bit <= 12; ++bit) {
        Counter counter;
        ASSERT_EQ(counter.until_stuck(1000), 1000);
        counter.stick(bit, true);
        EXPECT_EQ(counter.until_stuck(3000), 3000) << bit;
    }
}

TEST(CounterMonitor, ABitThatChangesAgainIsAcceptedAtOnce) {
    Counter counter;
    counter.rate = 37.3;
    counter.stick(5, true);
    ASSERT_LT(counter.until_stuck(300), 300);
    counter.release();
    // It is 0 in one of two halves-periods of the bit: two counts of 2^5 are passed in a tick.
    for (int k = 0; k < 8; ++k) (void)counter.half();
    EXPECT_EQ(counter.until_stuck(2000), 2000);
}

TEST(CounterMonitor, ABitThatStaysStuckStaysFoundWhileTheGyroTurns) {
    Counter counter;
    counter.rate = 37.3;
    counter.stick(5, true);
    ASSERT_LT(counter.until_stuck(300), 300);
    for (int k = 0; k < 4000; ++k) ASSERT_TRUE(counter.half()) << k;
    counter.rate = 0.0;
    for (int k = 0; k < 500; ++k) (void)counter.half();
    EXPECT_FALSE(counter.half()) << "a second at rest";
}

TEST(CounterMonitor, ReadingsThatDoNotFollowSayNothing) {
    CounterMonitorState s;
    std::mt19937_64 random{5};
    for (int k = 0; k < 5000; ++k) ASSERT_FALSE(step(s, k % 4 != 0, random() & ~std::uint64_t{16}));
}

// The counter wraps, and so do its lower bits: what is found is the same.
TEST(CounterMonitor, ACounterThatWrapsIsFollowed) {
    for (const double start : {-1000.0, 16777216.0 - 1000.0, 4294967296.0 - 1000.0}) {
        Counter counter;
        counter.phase_ = start;
        counter.rate = 3.3;
        ASSERT_EQ(counter.until_stuck(1000), 1000) << start;
        counter.stick(4, true);
        EXPECT_LT(counter.until_stuck(300), 300) << start;
    }
}

}  // namespace zlg::core::counter_monitor_test
