// Leads the processor's image through the scripts, and through a gyro's life in closed loop with the twin.
//
// usage: zlg_image_instructions IMAGE EMULATOR [LINE]
//
// bench/count_image runs it with an emulator that counts; LINE is where the gyro's line leads. Its lines, with tabs between the words:
//   halves NAME NUMBER       so many half-periods of this script, in the order in which they ran
//   stack_used_bytes NUMBER  the most in all of them
//   state NAME NUMBER        bytes that a part of the image remembers in

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <zlg/config/config.hpp>
#include <zlg/processor/qemu.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/wiring.hpp>

#include "scripts.hpp"

namespace {

using namespace zlg;

struct Scenario {
    std::string name;
    double duration_s = 0.0;
    config::Config config{};
};

std::vector<Scenario> scenarios() {
    std::vector<Scenario> all;
    // Two switches of the usual interval: as many as there are on average in such a time.
    all.push_back({.name = "life, defaults", .duration_s = 180.0});
    all.push_back({.name = "life, relock = joint", .duration_s = 60.0});
    all.back().config.compensation.relock = core::RelockMethod::joint;
    all.back().config.switching.interval_s = 10.0;
    all.push_back({.name = "life, magnetic = estimate", .duration_s = 60.0});
    all.back().config.compensation.magnetic = core::MagneticMethod::estimate;
    all.back().config.switching.interval_s = 5.0;
    all.push_back({.name = "life, 64 samples, dither, joint", .duration_s = 60.0});
    all.back().config.compensation.relock = core::RelockMethod::joint;
    all.back().config.gyro.fidelity = config::Fidelity::laser;  // which alone has edges to shift
    all.back().config.gyro.light_samples = 64;
    all.back().config.gyro.dither = core::DitherMethod::automatic;
    all.back().config.switching.interval_s = 10.0;
    all.push_back({.name = "life, everything, random faults", .duration_s = 60.0});
    all.back().config.compensation = {.relock = core::RelockMethod::joint, .magnetic = core::MagneticMethod::estimate};
    all.back().config.perimeter.loop = config::Loop::digital;
    all.back().config.switching = {.interval_s = 5.0, .schedule = config::Schedule::measured};
    all.back().config.faults.random_per_hour = 1800.0;
    return all;
}

void live(processor::QemuProcessor& processor, const Scenario& scenario) {
    rig::ClosedLoop loop{scenario.config, rig::motion(scenario.config), &processor};
    const auto halves = static_cast<std::int64_t>(2.0 * scenario.duration_s / scenario.config.gyro.tick_s);
    for (std::int64_t k = 0; k < halves; ++k) (void)loop.advance();
    fmt::print("halves\t{}\t{}\n", scenario.name, halves);
}

void lead(processor::QemuProcessor& processor, const bench::Script& script) {
    bench::ScriptedGyro gyro{script};
    core::ActuatorFrame actuator = processor.start({script.control, script.compensation});
    for (int k = 0; k < script.halves; ++k) actuator = processor.half(gyro.advance(actuator)).control.actuator;
    fmt::print("halves\t{}\t{}\n", script.name, script.halves);
}

// The host lays the states out as the processor does.
void tell_sizes() {
    const auto tell = [](const char* name, std::size_t bytes) { fmt::print("state\t{}\t{}\n", name, bytes); };
    tell("control: settings", sizeof(core::GyroControlConfig));
    tell("control: state", sizeof(core::GyroControlState));
    tell("compensation: settings", sizeof(core::GyroCompensationConfig));
    tell("compensation: state", sizeof(core::GyroCompensationState));
    tell("of that: gap_bridge with what it has learnt", sizeof(core::GapBridgeState));
    tell("of that: joint_relock", sizeof(core::JointRelockState));
    tell("of that: magnetic_drift", sizeof(core::MagneticDriftState));
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3 && argc != 4) {
        fmt::print(stderr, "usage: zlg_image_instructions IMAGE EMULATOR [LINE]\n");
        return 2;
    }
    processor::QemuProcessor processor{{.image = argv[1], .program = argv[2], .line = argc == 4 ? argv[3] : "null"}};
    for (const auto& all : {bench::usual_scripts(), bench::worst_scripts(), bench::estimating_scripts()})
        for (const auto& script : all) lead(processor, script);
    for (const auto& scenario : scenarios()) live(processor, scenario);
    fmt::print("stack_used_bytes\t{}\n", processor.stack_used_bytes());
    tell_sizes();
    return 0;
}
