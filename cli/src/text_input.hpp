#pragma once
// Text files of columns, as [analysis] describes them, or [motion].

#include <string>
#include <vector>

#include <zlg/study/analyze.hpp>

#include "options.hpp"

namespace zlg::cli {

// Adds an axis for each column that is asked for, or a test of a rate table.
//
// return  the configuration by which the file was read.
// errors  logs::IoError, logs::FormatError; config::ConfigError: nobody says what the columns hold, a column of times
// by
//         default, times that contradict the rate.
[[nodiscard]] config::Config read_text(const Options& options, const std::string& path,
                                       std::vector<study::AxisRecord>& axes, std::vector<study::TableResult>& tables);

}  // namespace zlg::cli
