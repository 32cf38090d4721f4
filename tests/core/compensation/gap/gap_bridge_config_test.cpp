#include <zlg/core/compensation/gap_bridge_config.hpp>

#include <gtest/gtest.h>

#include "compensation/compensation_support.hpp"

namespace gap_bridge_config_test {

using namespace zlg::core;
using namespace compensation_test;

TEST(GapBridgeCheck, TheDefaultsAndTheEdgesAreGood) {
    EXPECT_EQ(check(GapBridgeConfig{}), GapBridgeFault::none);
    EXPECT_EQ(check(GapBridgeConfig{.extrapolation_points = 8, .points_before = 8, .points_after = 8}),
              GapBridgeFault::none);
    EXPECT_EQ(check(GapBridgeConfig{
                  .method = BridgeMethod::constant, .extrapolation_points = 1, .points_before = 1, .points_after = 1}),
              GapBridgeFault::none);
    EXPECT_EQ(check(GapBridgeConfig{
                  .method = BridgeMethod::none, .extrapolation_points = 1, .points_before = 1, .points_after = 1}),
              GapBridgeFault::none);
}

TEST(GapBridgeCheck, PointsAreOneToEightOnEachSide) {
    for (const int bad : {-1, 0, 9, 1 << 30}) {
        EXPECT_EQ(check(GapBridgeConfig{.extrapolation_points = bad}), GapBridgeFault::extrapolation_points) << bad;
        EXPECT_EQ(check(GapBridgeConfig{.points_before = bad}), GapBridgeFault::points_before) << bad;
        EXPECT_EQ(check(GapBridgeConfig{.points_after = bad}), GapBridgeFault::points_after) << bad;
    }
}

TEST(GapBridgeCheck, ThereAreMorePointsThanTheOrder) {
    for (const auto method :
         {BridgeMethod::none, BridgeMethod::constant, BridgeMethod::linear, BridgeMethod::quadratic})
        for (int ahead = 1; ahead <= 4; ++ahead)
            for (int before = 1; before <= 3; ++before)
                for (int after = 1; after <= 3; ++after) {
                    const GapBridgeConfig config{.method = method,
                                                 .extrapolation_points = ahead,
                                                 .points_before = before,
                                                 .points_after = after};
                    const bool enough = ahead > order_of(method) && before + after > order_of(method);
                    EXPECT_EQ(check(config), enough ? GapBridgeFault::none : GapBridgeFault::order);
                }
}

// A given covariance of the motion that is none.
TEST(GapBridgeCheck, TheEstimateIsJudgedWhereItIsUsed) {
    const OptimalBridgeConfig bad{.learns = false};
    for (const auto method : {BridgeMethod::optimal, BridgeMethod::automatic})
        EXPECT_EQ(check(GapBridgeConfig{.method = method, .optimal = bad}), GapBridgeFault::optimal);
    EXPECT_EQ(check(GapBridgeConfig{.method = BridgeMethod::quadratic, .optimal = bad}), GapBridgeFault::none);
}

}  // namespace gap_bridge_config_test
