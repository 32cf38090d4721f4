#pragma once
// Files of other programs in place of our own logs: --mapping and --map.

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <zlg/logs/imported.hpp>
#include <zlg/logs/raw_log.hpp>

#include "options.hpp"

namespace zlg::cli {

void add_mapping_options(CLI::App& verb, Options& options);

void add_strict_option(CLI::App& verb, Options& options);

// errors  CLI::RuntimeError, exit status 1: --strict is given, and there are any.
void refuse_warnings(const Options& options, std::size_t n_warnings);

// One of both options is given.
[[nodiscard]] bool is_mapped(const Options& options);

// errors  logs::MappingError, logs::IoError.
[[nodiscard]] logs::Mapping mapping_of(const Options& options);

// A line on standard error for each.
void note_all(const std::string& path, const std::vector<std::string>& notes);

// A raw log, or the halves of a foreign file, with a line on standard error for each thing that was understood.
//
// n_warnings  becomes how many lines say what may be no measurement.
// errors  those of logs::RawReader, logs::look_at_foreign and logs::imported_raw; UsageError: the file is a log and
// needs no mapping.
[[nodiscard]] logs::RawReader open_raw(const Options& options, const std::string& path,
                                       std::size_t* n_warnings = nullptr);

// What a foreign file, or files of one record, say of themselves. errors  UsageError: one is a log of ours.
[[nodiscard]] logs::ForeignLook look_at(const Options& options, const std::vector<std::string>& paths);

}  // namespace zlg::cli
