#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <zlg/core/control/counter_monitor.hpp>

namespace zlg::core {
namespace {

constexpr CounterMonitorConfig config{.watches = true};

// A counter of a biased gyro; one bit of what it shows can be stuck.
class Counter {
public:
    double rate = 0.0;    // counts per half
    double jitter = 0.0;  // counts, of each reading
    int stuck_bit = -1;

    bool half() {
        sign_ = -sign_;
        phase_ += rate + sign_ * 150.0;
        const double shown = std::floor(phase_ + jitter * uniform_(random_));
        auto reading = static_cast<std::uint64_t>(static_cast<std::int64_t>(shown));
        if (stuck_bit >= 0) reading |= std::uint64_t{1} << stuck_bit;
        return step(config, state, true, reading);
    }
    // Halves until a bit is found stuck; n if none is.
    int until_stuck(int n) {
        for (int k = 0; k < n; ++k) {
            if (half()) return k;
        }
        return n;
    }

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
    for (const double frequency_hz : {0.01, 0.3, 7.03, 20.06}) {
        Counter counter;
        counter.jitter = 1.0;
        for (int k = 0; k < 20000; ++k) {
            counter.rate = 9.2 * std::sin(2.0 * 3.14159265 * frequency_hz * 0.0025 * k);
            ASSERT_FALSE(counter.half()) << frequency_hz << " Hz, half " << k;
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
                    counter.rate = swing * std::sin(2.0 * 3.14159265 * k / halves + 0.1 * start);
                    ASSERT_FALSE(counter.half()) << swing << " counts, " << halves << " halves, half " << k;
                }
            }
        }
    }
}

TEST(CounterMonitor, AStuckBitIsFoundWithinEightWindowsWhereTheGyroTurns) {
    for (int bit = 2; bit <= 8; ++bit) {
        Counter counter;
        counter.rate = 37.3;
        ASSERT_EQ(counter.until_stuck(1000), 1000);
        counter.stuck_bit = bit;
        EXPECT_LE(counter.until_stuck(1000), 8 * counter_window_halves) << bit;
        EXPECT_EQ(counter.state.stuck, std::uint32_t{1} << bit);
    }
}

TEST(CounterMonitor, ABitThatChangesAgainIsBelievedAgain) {
    Counter counter;
    counter.rate = 37.3;
    counter.stuck_bit = 5;
    ASSERT_LT(counter.until_stuck(300), 300);
    counter.stuck_bit = -1;
    for (int k = 0; k < 2 * counter_window_halves; ++k) (void)counter.half();
    EXPECT_EQ(counter.until_stuck(2000), 2000);
}

TEST(CounterMonitor, ABitThatStaysStuckStaysFound) {
    Counter counter;
    counter.rate = 37.3;
    counter.stuck_bit = 5;
    ASSERT_LT(counter.until_stuck(300), 300);
    for (int k = 0; k < 4000; ++k) ASSERT_TRUE(counter.half()) << k;
}

TEST(CounterMonitor, ReadingsThatDoNotFollowSayNothing) {
    CounterMonitorState s;
    std::mt19937_64 random{5};
    for (int k = 0; k < 5000; ++k) ASSERT_FALSE(step(config, s, k % 5 != 0, random() & ~std::uint64_t{16}));
    CounterMonitorState off;
    for (int k = 0; k < 500; ++k) ASSERT_FALSE(step({}, off, true, random() & ~std::uint64_t{16}));
}

}  // namespace
}  // namespace zlg::core
