// Shifted edges of the bias, as commanded and as recorded.
#include <zlg/core/gyro_compensation.hpp>

#include "gyro_control_support.hpp"

namespace zlg::core::test {
TEST_P(EitherLoop, EachRecordHoldsTheShiftThatWasCommandedForItsEnd) {
    Loop loop{dithered(GetParam(), DitherMethod::random)};
    std::int32_t commanded = loop.actuator.edge_offset_ticks;
    EXPECT_EQ(commanded, 0);
    for (int half = 0; half < 2200; ++half) {
        const auto miss = [&](SensorFrame& f) {
            if (half % 97 == 50) f.status = frame_missed;
        };
        const GyroControlOutput& out = loop.half(miss);
        ASSERT_EQ(out.record.edge_offset_ticks, commanded);
        commanded = out.actuator.edge_offset_ticks;
        ASSERT_EQ(out.health & health_timer_error, 0u);
    }
    EXPECT_EQ(loop.open_runs().size(), 5u);
}

// Whatever the law, the angle is that of the rotation to a count at the end of every tick: nothing is left of the
// shifts.
TEST_P(EitherLoop, ShiftedEdgesLeaveTheAngleAsItIs) {
    for (const DitherMethod method :
         {DitherMethod::none, DitherMethod::automatic, DitherMethod::paired, DitherMethod::random}) {
        for (const double rate_counts : {0.0, 50.3, -700.0}) {
            GyroControlConfig c = dithered(GetParam(), method);
            c.schedule.interval_ticks = 100000;
            Loop loop{c};
            loop.plant.rate_counts = rate_counts;
            GyroCompensationState state;
            for (int half = 0; half < 2000; ++half) {
                const CompensationOutput out = step(GyroCompensationConfig{}, state, loop.half().record);
                if (!out.has_sample) continue;
                ASSERT_NEAR(out.angle_arcsec / 3.263, rate_counts * (half + 1), 1.01) << half;
            }
        }
    }
}

TEST(GyroControl, TheLawFollowsTheRate) {
    for (const double rate_counts : {0.0, 1.0}) {
        Loop loop{dithered(LoopKind::analog, DitherMethod::automatic)};
        loop.plant.rate_counts = rate_counts;
        loop.ticks(300);
        EXPECT_EQ(loop.state.commutator.dither.law, rate_counts > 0.0 ? DitherLaw::random : DitherLaw::paired);
    }
}

}  // namespace zlg::core::test
