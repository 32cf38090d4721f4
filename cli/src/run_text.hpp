#pragma once
// The result of a run as text.

#include <string>

#include <zlg/config/config.hpp>
#include <zlg/study/run.hpp>

namespace zlg::cli {

// What happened, and a row for each compensation; those whose rows are equal to the digits shown share one.
[[nodiscard]] std::string run_text(const config::Config& config, const study::RunResult& result);

}  // namespace zlg::cli
