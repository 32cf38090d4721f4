#include <zlg/trials/scenarios.hpp>

#include <zlg/config/schema.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/wiring.hpp>

#include "test.hpp"

namespace zlg::scenarios_test {

TEST(Scenarios, are_gyros_that_can_be_run) {
    for (std::int64_t k = 0; k < 60; ++k) {
        const trials::Scenario s = trials::scenario(7, k, 20.0);
        SCOPED_TRACE(s.name);
        EXPECT_NO_THROW(config::check(s.config));
        rig::ClosedLoop loop{s.config, rig::motion(s.config)};
        EXPECT_EQ(loop.advance().record.half, 0);
        EXPECT_EQ(rig::run_ticks(s.config, rig::motion(s.config)), 4000);
    }
}

TEST(Scenarios, are_the_same_for_the_same_seed_and_differ_otherwise) {
    const auto settings = [](std::uint64_t seed, std::int64_t k) {
        return config::to_settings(trials::scenario(seed, k, 20.0).config);
    };
    EXPECT_EQ(settings(1, 3), settings(1, 3));
    EXPECT_NE(settings(1, 3), settings(1, 4));
    EXPECT_NE(settings(1, 3), settings(2, 3));
}

TEST(Scenarios, choose_every_method_and_every_fault) {
    std::set<core::RelockMethod> relocks;
    std::set<core::BridgeMethod> bridges;
    std::set<core::MagneticMethod> magnetics;
    std::set<core::DitherMethod> dithers;
    std::set<config::Schedule> schedules;
    std::set<config::Readout> readouts;
    std::set<twin::FaultKind> faults;
    bool all_faults = false;
    bool none = false;
    for (std::int64_t k = 0; k < 120; ++k) {
        const config::Config c = trials::scenario(1, k, 20.0).config;
        relocks.insert(*c.compensation.relock);
        bridges.insert(c.compensation.bridge);
        magnetics.insert(c.compensation.magnetic);
        dithers.insert(c.gyro.dither);
        schedules.insert(c.switching.schedule);
        readouts.insert(c.gyro.readout);
        faults.insert(c.faults.random_kinds.begin(), c.faults.random_kinds.end());
        all_faults |= c.faults.random_per_hour > 0.0 && c.faults.random_kinds.empty();
        none |= c.faults.random_per_hour == 0.0;
    }
    EXPECT_EQ(relocks.size(), 5u);
    EXPECT_EQ(bridges.size(), 5u);
    EXPECT_EQ(magnetics.size(), 3u);
    EXPECT_EQ(dithers.size(), 4u);
    EXPECT_EQ(schedules.size(), 2u);
    EXPECT_EQ(readouts.size(), 2u);
    EXPECT_EQ(faults.size(), twin::fault_kind_names.size());
    EXPECT_TRUE(all_faults);
    EXPECT_TRUE(none);
}

}  // namespace zlg::scenarios_test
