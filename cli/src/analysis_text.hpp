#pragma once
// An analysis as text to read, and as JSON.

#include <string>

#include <nlohmann/json.hpp>

#include <zlg/study/analyze.hpp>

namespace zlg::cli {

[[nodiscard]] std::string analysis_text(const config::Analysis& config, const study::AnalysisResult& result);

// Rates in arcsec/s throughout; what does not exist is null.
[[nodiscard]] nlohmann::json analysis_json(const config::Analysis& config, const study::AnalysisResult& result);

}  // namespace zlg::cli
