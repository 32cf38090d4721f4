#pragma once
// What is around the verbs of any of the programs.

#include <CLI/CLI.hpp>

namespace zlg::cli {

// Before anything else.
void begin_program();

// Parses the command line and runs its verb. Returns the exit code; an error has been said in one line.
int run_program(CLI::App& program, int argc, char** argv);

}  // namespace zlg::cli
