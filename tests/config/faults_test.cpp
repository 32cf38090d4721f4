#include <zlg/config/config.hpp>
#include <zlg/config/schema.hpp>

#include "test.hpp"

using namespace zlg;

TEST(Faults, every_kind_is_set_by_its_own_name) {
    for (const twin::FaultFacts& row : twin::fault_table) {
        config::Config config;
        config::apply_set(config, "faults.kind=" + std::string{row.name});
        EXPECT_EQ(config.faults.kind, std::vector{row.kind}) << row.name;
    }
}

TEST(Faults, a_gyro_has_none_unless_it_is_told) {
    const config::Config config;
    EXPECT_TRUE(config.faults.kind.empty());
    EXPECT_EQ(config.faults.random_per_hour, 0.0);
}
