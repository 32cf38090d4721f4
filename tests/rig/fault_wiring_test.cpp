#include "fault_wiring.hpp"
#include "config_with.hpp"

#include <zlg/config/schema.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/wiring.hpp>

namespace zlg::fault_wiring_test {

std::string complaint(const config::Config& c) {
    return test::refusal_by<config::ConfigError>([&] { rig::ClosedLoop loop{c, rig::motion(c)}; });
}

TEST(FaultWiring, FaultsThatAreToldReachTheTwin) {
    const auto faults =
        rig::faults_of(test::config_with({"faults.kind=[\"shock\", \"frame_late\"]", "faults.at_s=[1, 2]",
                                          "faults.duration_s=[0.01, 0.1]", "faults.size=[-0.1, 0]"}));
    ASSERT_EQ(faults.size(), 2u);
    EXPECT_EQ(faults[0].kind, twin::FaultKind::shock);
    EXPECT_EQ(faults[0].size, -0.1);
    EXPECT_EQ(faults[1].kind, twin::FaultKind::frame_late);
    EXPECT_EQ(faults[1].at_s, 2.0);
    EXPECT_EQ(faults[1].duration_s, 0.1);
    EXPECT_TRUE(rig::faults_of(config::Config{}).empty());
}

TEST(FaultWiring, RandomOnesLastAsLongAsTheRun) {
    const auto faults = rig::faults_of(test::config_with(
        {"faults.random_per_hour=3600", "run.duration_s=1000", "faults.random_kinds=[\"shock\", \"laser_off\"]"}));
    EXPECT_NEAR(static_cast<double>(faults.size()), 1000.0, 130.0);
    for (const twin::Fault& f : faults) {
        EXPECT_TRUE(f.kind == twin::FaultKind::shock || f.kind == twin::FaultKind::laser_off);
        EXPECT_LT(f.at_s, 1000.0);
    }
    EXPECT_NEAR(static_cast<double>(rig::faults_of(test::config_with({"faults.random_per_hour=3600"})).size()), 3600.0,
                250.0)
        << "an hour, unless given";
    EXPECT_NE(rig::faults_of(test::config_with({"faults.random_per_hour=10", "faults.random_seed=2"})).front().at_s,
              rig::faults_of(test::config_with({"faults.random_per_hour=10"})).front().at_s);
}

TEST(FaultWiring, AFaultIsFeltInTheLoopAndInItsRecords) {
    const config::Config c = test::config_with(
        {"faults.kind=frame_missed", "faults.at_s=0.1001", "faults.duration_s=0.005", "faults.size=0"});
    rig::ClosedLoop loop{c, rig::motion(c)};
    // The frames of the halves that end at 0.1025 and 0.105 s.
    for (int h = 0; h < 60; ++h) EXPECT_EQ((loop.advance().control.health & 1u) != 0, h == 40 || h == 41) << h;
}

TEST(FaultWiring, WhatCannotBeIsTold) {
    zlg::test::expect_contains(complaint(test::config_with({"faults.kind=shock"})), "allowed is as many of each");
    zlg::test::expect_contains(complaint(test::config_with({"faults.kind=beam_fades", "faults.at_s=1",
                                                            "faults.duration_s=1", "faults.size=2"})),
                               "fault beam_fades: faults.size is 2, allowed is 0..1");
    EXPECT_THROW(
        (void)rig::faults_of(test::config_with({"faults.random_per_hour=1", "motion.kind=file", "motion.path=a.txt"})),
        config::ConfigError);
    zlg::test::expect_contains(complaint(test::config_with({"faults.random_per_hour=1e6", "run.duration_s=1e9"})),
                               "random_per_hour");
    zlg::test::expect_contains(
        complaint(test::config_with({"perimeter.loop=exponential", "faults.random_per_hour=100"})), "exponential loop");
}

}  // namespace zlg::fault_wiring_test
