#include <zlg/core/health.hpp>

#include "support.hpp"

namespace zlg::core::health_test {

TEST(Health, BitsHaveDistinctNamesInTheirOrder) {
    const std::set<std::string> names(health_bit_names.begin(), health_bit_names.end());
    EXPECT_EQ(names.size(), health_bit_names.size());
    const auto name = [](HealthBit bit) {
        return std::string{health_bit_names[static_cast<std::size_t>(std::countr_zero(std::uint32_t{bit}))]};
    };
    EXPECT_EQ(name(health_light_lost), "light_lost");
    EXPECT_EQ(name(health_counter_jump), "counter_jump");
    EXPECT_EQ(name(health_half_wave_rejected), "half_wave_rejected");
    EXPECT_EQ(name(health_counter_bit_stuck), "counter_bit_stuck");
    EXPECT_EQ(name(health_coil_current), "coil_current");
    EXPECT_EQ(name(health_light_contradicted), "light_contradicted");
    EXPECT_EQ(name(health_edges_shifted), "edges_shifted");
    EXPECT_EQ(name(health_fringe_skewed), "fringe_skewed");
    EXPECT_EQ(std::uint32_t{1} << (health_bit_names.size() - 1), health_fringe_skewed);
}

}  // namespace zlg::core::health_test
