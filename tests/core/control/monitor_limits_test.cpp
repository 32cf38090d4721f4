#include <zlg/core/control/monitor_limits.hpp>

#include "support.hpp"

namespace zlg::core::monitor_limits_test {

TEST(MonitorLimits, EveryLimitHasItsRange) {
    const auto allows = [](auto change) { return test::allows<MonitorLimits>(change); };
    EXPECT_TRUE(allows([](auto&) {}));
    EXPECT_FALSE(allows([](auto& c) { c.counts = 0; }));
    EXPECT_FALSE(allows([](auto& c) { c.detuning_change_lambda2 = -1.0; }));
    EXPECT_FALSE(allows([](auto& c) { c.relock_ticks = -1; }));
    EXPECT_FALSE(allows([](auto& c) { c.coil_ratio = 1.1; }));
    EXPECT_FALSE(allows([](auto& c) { c.light_gain = 0.5; }));
    EXPECT_FALSE(allows([](auto& c) { c.light_noise = Wavelengths{not_a_number}; }));
    for (const auto limit : {&MonitorLimits::bias_counts, &MonitorLimits::coil_ratio, &MonitorLimits::bias_chi,
                             &MonitorLimits::light_gain, &MonitorLimits::detuning_change_lambda2}) {
        for (const double wrong : {-1.0, not_a_number, 1e16}) EXPECT_FALSE(allows([&](auto& c) { c.*limit = wrong; }));
    }
}

}  // namespace zlg::core::monitor_limits_test
