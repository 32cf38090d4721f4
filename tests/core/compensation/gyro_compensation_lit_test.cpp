// A gap with lit halves; their estimate is held against NumPy in tests/core/test_estimate.py.

#include <zlg/core/gyro_compensation.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "gyro_compensation_support.hpp"

namespace zlg::core::gyro_compensation_lit_test {

using namespace gyro_compensation_support;

constexpr int gap_tick = 400;
constexpr int gap_ticks = 3;
constexpr double miss_sq = 0.0484;

GyroCompensationConfig config_of(RelockMethod relock) {
    GyroCompensationConfig c;
    c.gyro.random_walk = ArcsecPerRootSecond{0.0};
    c.relock = {.method = relock};
    c.bridge.method = BridgeMethod::automatic;
    return c;
}

Halves records(const GyroCompensationConfig& config, bool lit) {
    Halves all;
    Recorder recorder{config, 1, 1};
    for (int h = 0; h < 2 * gap_tick + 120; ++h) {
        const double t = 0.0025 * h;
        const double motion = 28.0 * std::cos(2.0 * std::numbers::pi * 20.0 * t) + 11.0 * std::cos(377.0 * t + 1.0);
        const bool open = h >= 2 * gap_tick && h < 2 * (gap_tick + gap_ticks);
        HalfRecord r = recorder.half(motion, open ? miss_sq : 0.0);
        r.detuning_sq_lambda2 += 0.0033 * 0.0033;
        r.loop_closed = !open;
        r.lit = lit && h >= 2 * gap_tick + 3;
        if (open && h < 2 * gap_tick + 3) r.counts += 60 - 17 * (h % 3);  // dark
        all.push_back(r);
    }
    return all;
}

struct Outcome {
    Delivered all;
    std::vector<double> bias;  // by tick
};

Outcome outcome(const GyroCompensationConfig& config, const Halves& halves) {
    Outcome out;
    GyroCompensationState state;
    for (const HalfRecord& half : halves) {
        step_into(config, state, half, out.all);
        if (half.half % 2 != 0) out.bias.push_back(state.bias_arcsec);
    }
    drain_into(config, state, out.all);
    return out;
}

TEST(GyroCompensationLit, TheyNarrowTheGap) {
    for (const RelockMethod relock : {RelockMethod::mean_square, RelockMethod::joint}) {
        const GyroCompensationConfig config = config_of(relock);
        const Outcome with = outcome(config, records(config, true));
        const Outcome without = outcome(config, records(config, false));
        ASSERT_EQ(with.all.gaps.size(), 1u);
        EXPECT_LT(with.all.gaps[0].sigma_sum_arcsec, without.all.gaps[0].sigma_sum_arcsec);
        // In the last tick of the gap both halves were read.
        double read = 0.0;
        double truth = 0.0;
        for (int h = 2 * gap_tick + 4; h < 2 * gap_tick + 6; ++h) {
            const double t = 0.0025 * h;
            truth += 28.0 * std::cos(2.0 * std::numbers::pi * 20.0 * t) + 11.0 * std::cos(377.0 * t + 1.0);
        }
        read = with.all.rows[gap_tick + 2].dtheta_final_arcsec;
        EXPECT_NEAR(read, truth, 4.0 * config.gyro.scale.value() / std::sqrt(6.0));
    }
}

// Delivered and final values have the same sum, with lit halves too.
TEST(GyroCompensationLit, TheSumsOfBothColumnsAreEqual) {
    const GyroCompensationConfig config = config_of(RelockMethod::mean_square);
    const Outcome found = outcome(config, records(config, true));
    double delivered = 0.0;
    double final = 0.0;
    for (const AngleRow& row : found.all.rows) {
        delivered += row.dtheta_arcsec;
        final += row.dtheta_final_arcsec;
    }
    EXPECT_NEAR(delivered, final, 1e-9);
}

// Lit halves that turn by nonsense are refused: the angle is that without them, to the last bit. It may be a rotation, and
// sigma holds it.
TEST(GyroCompensationLit, NonsenseThatIsCalledLitIsRefused) {
    const GyroCompensationConfig config = config_of(RelockMethod::mean_square);
    Halves bad = records(config, true);
    Halves none = records(config, false);
    for (std::size_t h = 2 * gap_tick; h < 2 * (gap_tick + gap_ticks); ++h) {
        bad[h].counts = none[h].counts = static_cast<std::int64_t>(h * 7919 % 400) - 200;
        bad[h].lit = true;
    }
    const Outcome a = outcome(config, bad);
    const Outcome b = outcome(config, none);
    ASSERT_EQ(a.all.rows.size(), b.all.rows.size());
    for (std::size_t k = 0; k < a.all.rows.size(); ++k) {
        EXPECT_EQ(a.all.rows[k].dtheta_final_arcsec, b.all.rows[k].dtheta_final_arcsec);
        const bool in_gap = k >= gap_tick && k < gap_tick + gap_ticks;
        if (in_gap)
            EXPECT_GT(a.all.rows[k].sigma_arcsec, 100.0);
        else
            EXPECT_EQ(a.all.rows[k].sigma_arcsec, b.all.rows[k].sigma_arcsec);
    }
}

}  // namespace zlg::core::gyro_compensation_lit_test
