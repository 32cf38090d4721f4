// Runs the scripts under callgrind: one dump for each half-period of control, and one for each of compensation.
//
// usage: zlg_core_instructions PART PARTS
//
// Every PARTS-th script from number PART on, so that several processors share the work. bench/count_instructions runs it and reads
// the dumps.

#include <cstddef>
#include <cstdlib>
#include <span>
#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <valgrind/callgrind.h>

#include "scripts.hpp"

namespace {

using namespace zlg;

// Counts what `work` does, under a name.
template <class Work>
auto counted(const std::string& name, Work&& work) {
    CALLGRIND_TOGGLE_COLLECT;
    auto result = work();
    CALLGRIND_TOGGLE_COLLECT;
    CALLGRIND_DUMP_STATS_AT(name.c_str());
    return result;
}

void run(const bench::Script& script) {
    if (check(script.control) != core::GyroControlFault::none ||
        check(script.compensation) != core::GyroCompensationFault::none)
        throw std::logic_error{"the core refuses the script " + script.name};
    bench::ScriptedGyro gyro{script};
    core::GyroControlState control = initial_state(script.control);
    core::GyroCompensationState compensation;
    core::ActuatorFrame actuator = initial_actuator(script.control);
    for (int half = 0; half < script.halves; ++half) {
        const core::SensorFrame frame = gyro.advance(actuator);
        const auto controlled = counted(fmt::format("{}|{}|control", script.name, half),
                                        [&] { return step(script.control, control, frame); });
        const core::LightSamples light{std::span{frame.light_a}.first(frame.n_light),
                                       std::span{frame.light_b}.first(frame.has_light_b ? frame.n_light : 0)};
        counted(fmt::format("{}|{}|compensation", script.name, half),
                [&] { return step(script.compensation, compensation, controlled.record, light); });
        actuator = controlled.actuator;
    }
}

}  // namespace

int main(int argc, char** argv) {
    const std::size_t part = argc == 3 ? std::strtoul(argv[1], nullptr, 10) : 0;
    const std::size_t parts = argc == 3 ? std::strtoul(argv[2], nullptr, 10) : 1;
    if (part >= parts) throw std::invalid_argument{"usage: zlg_core_instructions PART PARTS"};
#ifdef __clang__
    fmt::print("clang {}\n", __clang_version__);
#else
    fmt::print("g++ {}\n", __VERSION__);
#endif
    const auto scripts = bench::scripts();
    for (std::size_t k = part; k < scripts.size(); k += parts) run(scripts[k]);
}
