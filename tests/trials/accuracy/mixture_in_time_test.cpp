// The mixture of a gap is spread over the halves between the last point and the tick that carries the correction: it must be
// finished by then, whatever the length of the gap and the method of re-lock, before the motion is known and after.

#include <gtest/gtest.h>

#include <zlg/core/gyro_compensation.hpp>
#include <zlg/rig/wiring.hpp>

#include "accuracy/parts.hpp"
#include "synthetic/gyro.hpp"

namespace zlg::trials {
namespace {

struct Resolved {
    bool any = false;
    bool learnt = false, halves = false, done = false, known = false;
    std::int64_t ticks = 0;
};

// One gap at tick `opening`; the state in the tick that resolves it.
Resolved resolve(core::RelockMethod relock, int gap_ticks, std::int64_t opening) {
    GyroLaw law;
    law.gap_ticks = gap_ticks;
    const auto config = rig::compensation_config(config_of(law), relock, core::BridgeMethod::automatic);
    core::GyroCompensationState state;
    SyntheticGyro gyro{law, {.tones = {{20.06, 12000.0}}}, 7};
    for (std::int64_t half = 0; half < 2 * (opening + 60); ++half) {
        if (half == 2 * opening) gyro.open();
        const SyntheticHalf now = gyro.advance();
        const core::CompensationOutput out = core::step(config, state, now.record, now.light);
        if (!out.has_sample || !out.sample.has_gap) continue;
        const core::EstimatedGap& e = state.bridge.estimate;
        return {true, e.learnt, e.problem.halves, is_done(e.mixture), e.mixture.estimate.known, out.sample.gap.n_ticks};
    }
    return {};
}

struct MixtureInTime : testing::TestWithParam<core::RelockMethod> {};

TEST_P(MixtureInTime, IsFinishedInTheTickThatNeedsIt) {
    for (int gap_ticks = 1; gap_ticks <= core::max_solved_gap; ++gap_ticks) {
        for (const std::int64_t opening : {12, 40, 400}) {
            SCOPED_TRACE(testing::Message() << "gap of " << gap_ticks << " at " << opening);
            const Resolved r = resolve(GetParam(), gap_ticks, opening);
            ASSERT_TRUE(r.any);
            EXPECT_EQ(r.ticks, gap_ticks);
            EXPECT_EQ(r.learnt, opening == 400);
            EXPECT_EQ(r.halves, r.learnt && GetParam() == core::RelockMethod::joint && gap_ticks <= 8);
            EXPECT_TRUE(r.done);
            EXPECT_TRUE(r.known);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Methods, MixtureInTime,
                         testing::Values(core::RelockMethod::joint, core::RelockMethod::mean_square,
                                         core::RelockMethod::detuning, core::RelockMethod::frequency,
                                         core::RelockMethod::none));

}  // namespace
}  // namespace zlg::trials
