#include <zlg/core/compensation/relock_profile_config.hpp>

#include "support.hpp"

namespace zlg::core::relock_profile_config_test {

TEST(RelockProfileConfig, CheckRefusesWhatIsMeaningless) {
    EXPECT_EQ(check(RelockProfileConfig{}), RelockProfileFault::none);
    for (const double k : {0.0, std::numeric_limits<double>::quiet_NaN(), 1e7, -1e-7})
        EXPECT_EQ(check(RelockProfileConfig{.discriminator_per_lambda = k}), RelockProfileFault::discriminator);
    EXPECT_EQ(check(RelockProfileConfig{.curve = {.n_nodes = 1}}), RelockProfileFault::curve);
}

}  // namespace zlg::core::relock_profile_config_test
