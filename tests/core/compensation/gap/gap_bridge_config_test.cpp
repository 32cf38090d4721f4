#include <zlg/core/compensation/gap_bridge_config.hpp>

#include "gap_bridge_support.hpp"

namespace zlg::core::gap_bridge_support::config_test {

TEST(GapBridgeCheck, TheDefaultsAndTheEdgesAreGood) {
    EXPECT_TRUE(is_allowed(GapBridgeConfig{}));
    EXPECT_TRUE(is_allowed(GapBridgeConfig{.extrapolation_points = 8, .points_before = 8, .points_after = 8}));
}

TEST(GapBridgeCheck, PointsAreOneToEightOnEachSide) {
    for (const int bad : {-1, 0, 9, 1 << 30}) {
        EXPECT_FALSE(is_allowed(GapBridgeConfig{.extrapolation_points = bad})) << bad;
        EXPECT_FALSE(is_allowed(GapBridgeConfig{.points_before = bad})) << bad;
        EXPECT_FALSE(is_allowed(GapBridgeConfig{.points_after = bad})) << bad;
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
                    EXPECT_EQ(is_allowed(config), enough);
                }
}

TEST(GapBridgeCheck, TheEstimateIsJudgedWhereItIsUsed) {
    for (const int bad : {0, 41}) {
        EXPECT_FALSE(is_allowed(GapBridgeConfig{.method = BridgeMethod::automatic, .gap_ticks = bad}));
        EXPECT_TRUE(is_allowed(GapBridgeConfig{.gap_ticks = bad}));
    }
    for (const int bad : {-1, 65})
        EXPECT_FALSE(is_allowed(GapBridgeConfig{.method = BridgeMethod::automatic, .relock_ticks = bad}));
}

// max(16, gap_ticks) + max(8, relock_ticks where corrected) + ceil(80 ms/tick) + 1
TEST(GapBridgeConfig, TheDelayOfAnEstimate) {
    const auto delay = [](double tick_s, int gap_ticks, RelockMethod relock, int relock_ticks) {
        return final_delay_ticks({.tick = Seconds{tick_s}}, {.method = BridgeMethod::automatic,
                                                             .gap_ticks = gap_ticks,
                                                             .relock = relock,
                                                             .relock_ticks = relock_ticks});
    };
    EXPECT_EQ(delay(0.005, 3, RelockMethod::joint, 20), 53);
    EXPECT_EQ(delay(0.005, 3, RelockMethod::none, 20), 16 + 8 + 16 + 1);
    EXPECT_EQ(delay(0.005, 40, RelockMethod::detuning, 64), 40 + 64 + 16 + 1);
    EXPECT_EQ(delay(0.02, 17, RelockMethod::joint, 4), 17 + 8 + 4 + 1);
    EXPECT_EQ(delay(0.003, 1, RelockMethod::joint, 9), 16 + 9 + 27 + 1);
    EXPECT_EQ(delay(0.1, 1, RelockMethod::joint, 20), 16 + 20 + 1 + 1);
}

}  // namespace zlg::core::gap_bridge_support::config_test
