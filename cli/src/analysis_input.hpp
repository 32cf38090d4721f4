#pragma once
// Recordings of any kind as axes to be analysed.

#include <string>
#include <vector>

#include <zlg/study/analyze.hpp>

#include "options.hpp"

namespace zlg::cli {

struct AnalysisInput {
    config::Config config;  // of the first file: what it says of itself, the options over it
    std::vector<study::AxisRecord> axes;
    std::vector<study::TableResult> tables;  // where a file has the rate of a rate table, instead of axes
};

// Raw logs go through the compensation first. A log of either kind gives its angle, and the error of the angle where it
// holds the true one; a file of another program each of its axes.
//
// errors  logs::IoError, logs::FormatError; logs::MappingError: what a file holds is open; config::ConfigError.
[[nodiscard]] AnalysisInput read_analysis_input(const Options& options, const std::vector<std::string>& paths);

}  // namespace zlg::cli
