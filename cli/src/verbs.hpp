#pragma once
// One function per verb: it adds itself to the command line, and runs when it is called.

#include <CLI/CLI.hpp>

#include <zlg/sweep/sweep.hpp>

namespace zlg::cli {

void add_run(CLI::App& program);
void add_simulate(CLI::App& program);
void add_process(CLI::App& program);
void add_design(CLI::App& program);
void add_paper(CLI::App& program);
void add_sweep(CLI::App& program, const sweep::Crew& crew = {});  // crew  others than the threads of this process
void add_convert(CLI::App& program);
void add_calibrate(CLI::App& program);
void add_import(CLI::App& program);
void add_follow(CLI::App& program);
void add_inspect(CLI::App& program);
void add_analyze(CLI::App& program);
void add_accept(CLI::App& program);
void add_lab(CLI::App& program);
void add_settings(CLI::App& program);

}  // namespace zlg::cli
