#pragma once
// Text files of columns, as [analysis] describes them, or [motion].

#include <string>

#include "analysis_input.hpp"

namespace zlg::cli {

// Adds an axis for each column that is asked for, or a test of a rate table.
//
// errors  logs::IoError, logs::FormatError; config::ConfigError: nobody says what the columns hold, a column of times by
//         default, times that contradict the rate.
[[nodiscard]] config::Config read_text(const Options& options, const std::string& path, AnalysisInput& input);

}  // namespace zlg::cli
