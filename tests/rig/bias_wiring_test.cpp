#include "bias_wiring.hpp"

#include <gtest/gtest.h>

#include <zlg/config/schema.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/wiring.hpp>

namespace {

using namespace zlg;

config::Config with(std::initializer_list<std::string_view> settings) {
    config::Config c;
    for (const auto setting : settings) config::apply_set(c, setting);
    return c;
}

TEST(BiasWiring, TheCounterFollowsTheBiasAndFourHundredDegreesASecond) {
    // 60 kHz/(1 - 0.01) + 1 440 000/3.263 Hz.
    EXPECT_NEAR(rig::counter_max_hz(config::Gyro{}), 1.01 * (60606.06 + 441311.68), 0.01);
    EXPECT_EQ(rig::counter_max_hz(with({"gyro.counter_max_hz=1e5"}).gyro), 1e5);
    config::Config c = with({"gyro.counter_max_hz=1e5", "motion.kind=constant", "motion.rate_arcsec_s=1e6"});
    rig::ClosedLoop loop{c, rig::motion(c)};
    (void)loop.advance();
    EXPECT_EQ(loop.sensor().counter, 250u);
}

}  // namespace
