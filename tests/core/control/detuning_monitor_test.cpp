#include <zlg/core/control/detuning_monitor.hpp>

#include "support.hpp"

namespace zlg::core::detuning_monitor_test {

constexpr MonitorLimits config{.detuning_change_lambda2 = 0.002, .relock_ticks = 20};

struct Gyro {
    DetuningMonitorState state;
    bool settled = true;

    bool tick(double first_lambda2, double second_lambda2, bool good = true) {
        const bool first = step(config, state, false, good, settled, true, first_lambda2);
        EXPECT_FALSE(first);
        return step(config, state, true, good, settled, true, second_lambda2);
    }
    void ticks(int n) {
        for (int k = 0; k < n; ++k) EXPECT_FALSE(tick(0.0, 0.0));
    }
};

TEST(DetuningMonitor, APushWithinATickIsSeenWhicheverHalfItIsIn) {
    for (const bool late : {true, false}) {
        Gyro gyro;
        gyro.ticks(30);
        EXPECT_FALSE(gyro.tick(0.0, 0.0019));
        EXPECT_TRUE(late ? gyro.tick(0.0, 0.0021) : gyro.tick(0.0021, 0.0));
    }
}

TEST(DetuningMonitor, ADetuningThatStaysLeavesNothing) {
    Gyro gyro;
    gyro.ticks(30);
    EXPECT_FALSE(gyro.tick(0.04, 0.04));
}

TEST(DetuningMonitor, AfterAGapTheRelockIsCorrectedAndNotJudged) {
    Gyro gyro;
    gyro.ticks(30);
    EXPECT_FALSE(gyro.tick(0.0, 0.0, false));
    for (int k = 0; k < 20; ++k) EXPECT_FALSE(gyro.tick(0.05, 0.03)) << k;
    EXPECT_TRUE(gyro.tick(0.05, 0.03));
    EXPECT_FALSE(gyro.tick(0.05, 0.03));  // that tick is a gap now
}

TEST(DetuningMonitor, NothingIsJudgedBeforeTheLockNorWithoutAMeasurement) {
    Gyro gyro;
    gyro.settled = false;
    gyro.ticks(30);
    EXPECT_FALSE(gyro.tick(0.0, 0.05));
    gyro.settled = true;
    EXPECT_FALSE(step(config, gyro.state, false, true, true, false, 0.0));
    EXPECT_FALSE(step(config, gyro.state, true, true, true, true, 0.05));
    DetuningMonitorState off;
    for (int k = 0; k < 100; ++k) EXPECT_FALSE(step({}, off, k % 2 != 0, true, true, true, k % 2 == 0 ? 0.0 : 1.0));
}

}  // namespace zlg::core::detuning_monitor_test
