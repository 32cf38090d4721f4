// Runs the processor's image through the scripts, and in closed loop with the twin.
//
// usage: zlg_image_instructions IMAGE EMULATOR
//
// bench/count_image runs it with an emulator that counts. Its lines, with tabs between the words:
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
    using core::RelockMethod;
    // Two switches of the usual interval: as many as there are on average in such a time.
    return {
        {.name = "life, defaults", .duration_s = 180.0},
        {.name = "life, relock = joint",
         .duration_s = 60.0,
         .config = {.switching = {.interval_s = 10.0}, .compensation = {.relock = RelockMethod::joint}}},
        {.name = "life, magnetic = estimate",
         .duration_s = 60.0,
         .config = {.switching = {.interval_s = 5.0}, .compensation = {.magnetic = core::MagneticMethod::estimate}}},
        {.name = "life, 64 samples, dither, joint",
         .duration_s = 60.0,
         // The laser alone has edges to shift.
         .config = {.gyro = {{.fidelity = config::Fidelity::laser, .light_samples = 64}, core::DitherMethod::automatic},
                    .switching = {.interval_s = 10.0},
                    .compensation = {.relock = RelockMethod::joint}}},
        {.name = "life, everything, random faults",
         .duration_s = 60.0,
         .config = {.perimeter = {{.loop = config::Loop::digital}},
                    .switching = {.interval_s = 5.0, .schedule = config::Schedule::measured},
                    .compensation = {.relock = RelockMethod::joint, .magnetic = core::MagneticMethod::estimate},
                    .faults = {.random_per_hour = 1800.0}}}};
}

void run_in_loop(processor::QemuProcessor& processor, const Scenario& scenario) {
    rig::ClosedLoop loop{scenario.config, rig::motion(scenario.config), &processor};
    const auto halves = static_cast<std::int64_t>(2.0 * scenario.duration_s / scenario.config.gyro.tick_s);
    for (std::int64_t k = 0; k < halves; ++k) (void)loop.advance();
    fmt::print("halves\t{}\t{}\n", scenario.name, halves);
}

void run_script(processor::QemuProcessor& processor, const bench::Script& script) {
    bench::ScriptedGyro gyro{script};
    core::ActuatorFrame actuator = processor.start({script.control, script.compensation});
    for (int k = 0; k < script.halves; ++k) actuator = processor.half(gyro.advance(actuator)).control.actuator;
    fmt::print("halves\t{}\t{}\n", script.name, script.halves);
}

// The host lays the states out as the processor does.
void print_sizes() {
    const auto print = [](const char* name, std::size_t bytes) { fmt::print("state\t{}\t{}\n", name, bytes); };
    print("control: settings", sizeof(core::GyroControlConfig));
    print("control: state", sizeof(core::GyroControlState));
    print("compensation: settings", sizeof(core::GyroCompensationConfig));
    print("compensation: state", sizeof(core::GyroCompensationState));
    print("of that: gap_bridge with what it has learnt", sizeof(core::GapBridgeState));
    print("of that: the estimates of switches", sizeof(core::BackgroundWork));
    print("of that: magnetic_drift", sizeof(core::MagneticDriftState));
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        fmt::print(stderr, "usage: zlg_image_instructions IMAGE EMULATOR\n");
        return 2;
    }
    processor::QemuProcessor processor{{.image = argv[1], .program = argv[2]}};
    for (const auto& script : bench::scripts()) run_script(processor, script);
    for (const auto& scenario : scenarios()) run_in_loop(processor, scenario);
    fmt::print("stack_used_bytes\t{}\n", processor.stack_used_bytes());
    print_sizes();
    return 0;
}
