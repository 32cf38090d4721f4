#pragma once
// The campaigns as the program offers them.

#include <functional>

#include <CLI/CLI.hpp>

namespace zlg::trials {

// What a campaign does: 0, or 1 where a limit is missed.
using Work = std::function<int()>;

// Each adds its options, and does its work with what they are set to by then.
Work accuracy(CLI::App& app);
Work manoeuvres(CLI::App& app);
Work sigma(CLI::App& app);
Work faults(CLI::App& app);
Work gyros(CLI::App& app);
Work environment(CLI::App& app);
Work drift(CLI::App& app);
Work magnetic(CLI::App& app);
Work intervals(CLI::App& app);
Work noise_terms(CLI::App& app);
Work accept_units(CLI::App& app);
Work processor_bits(CLI::App& app);
Work events(CLI::App& app);
Work maths(CLI::App& app);

// Of every campaign that draws and has threads: the threads change no figure.
template <class Task> void add_seed_and_threads(CLI::App& app, Task& task) {
    app.add_option("--seed", task.seed, "of all that is drawn");
    app.add_option("--threads", task.threads)->check(CLI::PositiveNumber);
}

}  // namespace zlg::trials
