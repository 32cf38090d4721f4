#pragma once
// What the help says beyond the options themselves: groups of verbs, examples, what kind of value an option takes.

#include <string>

#include <CLI/CLI.hpp>

namespace zlg::cli {

// Adds it to all verbs, and to each the option --quiet; then the verb `help`. To be called when all verbs are there.
void complete_help(CLI::App& program);

// Null where there is none of this name.
[[nodiscard]] const CLI::App* find_verb(const CLI::App& program, const std::string& name);

// One line: a verb of this name is not there, and which one is the nearest.
[[nodiscard]] std::string unknown_verb(const CLI::App& program, const std::string& name);

}  // namespace zlg::cli
