#include "bias_wiring.hpp"
#include "config_with.hpp"

#include <zlg/config/schema.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/wiring.hpp>

namespace zlg::bias_wiring_test {

TEST(BiasWiring, TheCounterFollowsTheBiasAndFourHundredDegreesASecond) {
    // 60 kHz/(1 - 0.01) + 1 440 000/3.263 Hz.
    EXPECT_NEAR(rig::counter_max_hz(config::Gyro{}), 1.01 * (60606.06 + 441311.68), 0.01);
    config::Config c = test::config_with({"motion.kind=constant", "motion.rate_arcsec_s=1e6"});
    c.gyro.counter_max_hz = 1e5;
    EXPECT_EQ(rig::counter_max_hz(c.gyro), 1e5);
    rig::ClosedLoop loop{c, rig::motion(c)};
    (void)loop.advance();
    EXPECT_EQ(loop.sensor().counter, 250u);
}

}  // namespace zlg::bias_wiring_test
