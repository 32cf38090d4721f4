// The image of the processor against this program: are all outputs of the core equal in every bit?
//
// Scenarios of 20 s each, drawn from the seed, with faults; a new processor for every tenth. Prints what was compared,
// in Markdown. Exit 1 if a bit differs.

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

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
    std::int64_t scenarios = 0;
    std::int64_t halves = 0;
    std::int64_t differing = 0;
    std::int64_t states_differing = 0;
    std::int64_t switches = 0;
    std::int64_t invalid_halves = 0;
    std::int64_t unhealthy_halves = 0;
    std::int64_t placed_halves = 0;
    std::int64_t lit_halves = 0;
    std::string first_difference;
    std::uint64_t hash = 0;
};

void run(const Scenario& scenario, processor::QemuProcessor& image, Total& total) {
    ComparedProcessor both{image};
    rig::ClosedLoop loop{scenario.config, rig::motion(scenario.config), &both};
    const std::int64_t halves = 2 * rig::run_ticks(scenario.config, rig::motion(scenario.config));
    for (std::int64_t k = 0; k < halves; ++k) {
        const rig::LoopHalf half = loop.advance();
        total.switches += half.control.has_event ? 1 : 0;
        total.invalid_halves += half.record.valid ? 0 : 1;
        total.unhealthy_halves += half.control.health != 0 ? 1 : 0;
        total.placed_halves += core::has_fringe(half.record) ? 1 : 0;
        total.lit_halves += half.record.lit && !half.record.loop_closed ? 1 : 0;
    }
    rig::hand_over_rest([&] { return both.drain(); }, rig::ignored);
    if (!(image.state() == both.state())) ++total.states_differing;
    if (total.first_difference.empty() && both.differing() > 0)
        total.first_difference = fmt::format("{}, {}", scenario.name, both.first_difference());
    ++total.scenarios;
    total.halves += both.halves();
    total.differing += both.differing();
    total.hash = (total.hash ^ both.hash()) * 0x100000001b3u;
}

void print(const Total& t, double wall_s) {
    fmt::print("| compared | |\n|---|---|\n");
    fmt::print("| scenarios of {} s | {} |\n", scenario_s, t.scenarios);
    fmt::print("| gyro-hours | {:.2f} |\n", static_cast<double>(t.scenarios) * scenario_s / 3600.0);
    fmt::print("| half-periods | {} |\n", t.halves);
    fmt::print("| switches, returns and searches that ended in a lock | {} |\n", t.switches);
    fmt::print("| half-periods not valid | {} |\n", t.invalid_halves);
    fmt::print("| half-periods with a health bit | {} |\n", t.unhealthy_halves);
    fmt::print("| half-periods with the place within the fringe | {} |\n", t.placed_halves);
    fmt::print("| half-periods of gaps that are called lit | {} |\n", t.lit_halves);
    fmt::print("| outputs that differ in a bit | {} |\n", t.differing);
    fmt::print("| final states that differ | {} |\n", t.states_differing);
    fmt::print("| hash of all outputs | {:016x} |\n", t.hash);
    fmt::print(stderr, "{:.0f} s, {:.0f} half-periods a second\n", wall_s, static_cast<double>(t.halves) / wall_s);
    if (!t.first_difference.empty()) fmt::print(stderr, "first difference: {}\n", t.first_difference);
}

struct Task {
    std::string image;
    double minutes = 10.0;
    std::uint64_t seed = 1;
};

int compare(const Task& task) {
    const auto start = std::chrono::steady_clock::now();
    Total total;
    std::optional<processor::QemuProcessor> image;
    for (std::int64_t k = 0; k < static_cast<std::int64_t>(task.minutes * 60.0 / scenario_s); ++k) {
        if (k % 10 == 0) image.emplace(processor::QemuOptions{.image = task.image});
        run(scenario(task.seed, k, scenario_s), *image, total);
    }
    print(total, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
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
