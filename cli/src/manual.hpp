#pragma once
// Man pages and completions, made of what the command line itself knows: its verbs, options and their texts.

#include <string>

#include <CLI/CLI.hpp>

namespace zlg::cli {

// The hidden option `--manual FOLDER`, with which a package is built: all pages and completions. Call it after all
// verbs are there.
void add_manual(CLI::App& program);

// The page zlg(1), or zlg-VERB(1).
[[nodiscard]] std::string man_page(const CLI::App& program);
[[nodiscard]] std::string man_page(const CLI::App& program, const CLI::App& verb);

// shell  "bash", "zsh" or "fish".
[[nodiscard]] std::string completion(const CLI::App& program, const std::string& shell);

}  // namespace zlg::cli
