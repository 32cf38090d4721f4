// The image of the processor against this program: are all outputs of the core equal in every bit?
//
// Scenarios of 20 s each, drawn from the seed, with faults; a new processor for every tenth. Prints what was compared,
// in Markdown. Exit 1 if a bit differs.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <zlg/processor/qemu.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/replay.hpp>
#include <zlg/rig/wiring.hpp>
#include <zlg/trials/compared.hpp>
#include <zlg/trials/scenarios.hpp>

#include "campaigns.hpp"

namespace zlg::trials {
namespace {

constexpr double scenario_s = 20.0;

struct Total {
    std::int64_t scenarios = 0, halves = 0, differing = 0, states_differing = 0;
    std::int64_t switches = 0, invalid = 0, unhealthy = 0, placed = 0, lit = 0;
    std::string first_difference;
    std::uint64_t hash = 0;
};

void run(const Scenario& scenario, processor::QemuProcessor& image, Total& total) {
    ComparedProcessor both{image};
    rig::ClosedLoop loop{scenario.config, rig::motion(scenario.config), &both};
    const std::int64_t halves = 2 * rig::run_ticks(scenario.config, rig::motion(scenario.config));
    for (std::int64_t k = 0; k < halves; ++k) {
        const rig::LoopHalf half = loop.advance();
        total.switches += half.control.has_event;
        total.invalid += !half.record.valid;
        total.unhealthy += half.control.health != 0;
        total.placed += core::has_fringe(half.record);
        total.lit += half.record.lit && !half.record.loop_closed;
    }
    rig::hand_over_rest([&] { return both.drain(); }, rig::ignored);
    total.states_differing += !(image.state() == both.state());
    if (total.first_difference.empty() && both.differing() > 0)
        total.first_difference = fmt::format("{}, {}", scenario.name, both.first_difference());
    ++total.scenarios;
    total.halves += both.halves();
    total.differing += both.differing();
    total.hash = (total.hash ^ both.hash()) * 0x100000001b3u;
}

void print(const Total& t) {
    fmt::print("| compared | |\n|---|---|\n| scenarios of {} s | {} |\n| gyro-hours | {:.2f} |\n", scenario_s,
               t.scenarios, static_cast<double>(t.scenarios) * scenario_s / 3600.0);
    for (const auto& [what, n] : {std::pair{"half-periods", t.halves},
                                  {"switches, returns and searches that ended in a lock", t.switches},
                                  {"half-periods not valid", t.invalid},
                                  {"half-periods with a health bit", t.unhealthy},
                                  {"half-periods with the place within the fringe", t.placed},
                                  {"half-periods of gaps that are called lit", t.lit},
                                  {"outputs that differ in a bit", t.differing},
                                  {"final states that differ", t.states_differing}})
        fmt::print("| {} | {} |\n", what, n);
    fmt::print("| hash of all outputs | {:016x} |\n", t.hash);
    if (!t.first_difference.empty()) fmt::print(stderr, "first difference: {}\n", t.first_difference);
}

struct Task {
    std::string image;
    double minutes = 10.0;
    std::uint64_t seed = 1;
};

int compare(const Task& task) {
    Total total;
    std::optional<processor::QemuProcessor> image;
    for (std::int64_t k = 0; k < static_cast<std::int64_t>(task.minutes * 60.0 / scenario_s); ++k) {
        if (k % 10 == 0) image.emplace(processor::QemuOptions{.image = task.image});
        run(scenario(task.seed, k, scenario_s), *image, total);
    }
    print(total);
    return total.differing == 0 && total.states_differing == 0 ? 0 : 1;
}

}  // namespace

Work processor_bits(CLI::App& app) {
    const auto task = std::make_shared<Task>();
    app.add_option("IMAGE", task->image)->required();
    app.add_option("GYRO_MINUTES", task->minutes)->check(CLI::PositiveNumber);
    app.add_option("--seed", task->seed);
    return [task] { return compare(*task); };
}

}  // namespace zlg::trials
