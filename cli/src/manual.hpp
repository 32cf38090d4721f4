#pragma once
// Man pages and completion, made of what the command line itself knows: its verbs, options and their texts.

#include <CLI/CLI.hpp>

namespace zlg::cli {

// The hidden option `--manual FOLDER`, with which a package is built: all pages, and completion for bash. Call it
// after all verbs are there.
void add_manual(CLI::App& program);

}  // namespace zlg::cli
