#include <zlg/core/compensation/relock_profile_config.hpp>

#include <gtest/gtest.h>

#include <limits>

namespace relock_profile_config_test {

using namespace zlg::core;

constexpr double nan_d = std::numeric_limits<double>::quiet_NaN();

TEST(RelockProfileConfig, check_refuses_what_is_meaningless) {
    const auto fault = [](auto&& spoil) {
        RelockProfileConfig c;
        spoil(c);
        return check(c);
    };
    EXPECT_EQ(check(RelockProfileConfig{}), RelockProfileFault::none);
    for (const double k : {0.0, nan_d, 1e7, -1e-7})
        EXPECT_EQ(fault([k](auto& c) { c.discriminator_per_lambda = k; }), RelockProfileFault::discriminator);
    EXPECT_EQ(fault([](auto& c) { c.curve.n_nodes = 1; }), RelockProfileFault::curve);
}

}  // namespace relock_profile_config_test
