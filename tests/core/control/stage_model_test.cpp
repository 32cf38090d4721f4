#include "control/stage_model.hpp"

#include "support.hpp"

namespace zlg::core::stage_model_test {

constexpr double half_s = 0.0025;
constexpr PiezoRange range{};

StageModel default_stage(int n) { return stage_model(0.001, 4000.0, half_s / n); }

// Small steps of Euler's rule.
struct Brute {
    double v;
    double mean_v = 0.0;
};

Brute brute(double v, const StageMove& move, int n) {
    Brute b{v};
    constexpr int steps = 20000;
    for (int k = 0; k < n * steps; ++k) {
        const double dt = half_s / (n * steps);
        b.mean_v += b.v / (n * steps);
        b.v += dt * std::clamp((move.set_point_v[static_cast<std::size_t>(k / steps)] - b.v) / 0.001, -4000.0, 4000.0);
    }
    return b;
}

TEST(StageModel, FollowsTheLagAndItsCurrentLimitExactly) {
    for (const double target : {150.5, 153.0, 157.0, 190.0, 110.0, 147.0}) {
        for (const int n : {1, 3, 16}) {
            const StageMove move = move_towards(default_stage(n), range, 150.0, target, n);
            const Brute expected = brute(150.0, move, n);
            EXPECT_NEAR(move.end_v, expected.v, 1e-3) << target << " " << n;
            EXPECT_NEAR(move.mean_v, expected.mean_v, 1e-3) << target << " " << n;
        }
    }
}

TEST(StageModel, ASingleSetPointIsTheTarget) {
    const StageMove move = move_towards(default_stage(1), range, 150.0, 152.0, 1);
    EXPECT_EQ(move.set_point_v[0], 152.0);
    EXPECT_NEAR(move.end_v, 152.0 - 2.0 * std::exp(-2.5), 1e-12);
}

TEST(StageModel, SixteenSetPointsArriveAsSoonAsTheCurrentAllows) {
    // 4 V at 4 V/ms: 1 ms, six and a half pieces of 0.156 ms. The lag alone would leave 0.33 V after the half.
    const StageMove move = move_towards(default_stage(16), range, 150.0, 154.0, 16);
    EXPECT_NEAR(move.end_v, 154.0, 1e-9);
    EXPECT_GT(move.set_point_v[0], 154.0);
    EXPECT_EQ(move.set_point_v[15], 154.0);
    // Mean of a ramp of 1 ms and a rest of 1.5 ms.
    EXPECT_NEAR(move.mean_v, 154.0 - 4.0 * 0.5 * 1.0 / 2.5, 0.02);
}

TEST(StageModel, NoSetPointLeavesTheRange) {
    const StageMove move = move_towards(default_stage(16), range, 297.0, 300.0, 16);
    for (const double v : move.set_point_v) EXPECT_LE(v, 300.0);
    EXPECT_NEAR(move.end_v, 300.0, 3.0 * std::exp(-2.5) + 1e-9);
}

}  // namespace zlg::core::stage_model_test
