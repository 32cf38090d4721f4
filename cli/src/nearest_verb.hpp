#pragma once
// What was wrong with a command line, in one line: where its verb is unknown, with the nearest one that exists.

#include <string>

#include <CLI/CLI.hpp>

namespace zlg::cli {

[[nodiscard]] std::string explain(const CLI::App& program, const CLI::ParseError& error, int argc, char** argv);

}  // namespace zlg::cli
