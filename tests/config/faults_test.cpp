#include <gtest/gtest.h>

#include <set>
#include <string>
#include <zlg/config/config.hpp>
#include <zlg/config/schema.hpp>

using namespace zlg::config;

TEST(Faults, every_kind_is_set_by_its_own_name) {
    const std::set<std::string_view> distinct{fault_kind_names.begin(), fault_kind_names.end()};
    EXPECT_EQ(distinct.size(), fault_kind_names.size());
    for (std::size_t k = 0; k < fault_kind_names.size(); ++k) {
        Config config;
        apply_set(config, "faults.kind=" + std::string{fault_kind_names[k]});
        EXPECT_EQ(config.faults.kind, std::vector{static_cast<FaultKind>(k)}) << fault_kind_names[k];
    }
    EXPECT_EQ(fault_kind_names[static_cast<std::size_t>(FaultKind::laser_off)], "laser_off");
    EXPECT_EQ(fault_kind_names[static_cast<std::size_t>(FaultKind::counter_bit_stuck)], "counter_bit_stuck");
    EXPECT_EQ(fault_kind_names[static_cast<std::size_t>(FaultKind::overspeed)], "overspeed");
}

TEST(Faults, a_gyro_has_none_unless_it_is_told) {
    const Config config;
    EXPECT_TRUE(config.faults.kind.empty());
    EXPECT_EQ(config.faults.random_per_hour, 0.0);
}
