#pragma once
// An analysis as JSON.

#include <nlohmann/json.hpp>

#include <zlg/study/analyze.hpp>

namespace zlg::cli {

// Rates in arcsec/s throughout; what does not exist is null.
[[nodiscard]] nlohmann::json analysis_json(const study::AnalysisResult& result);

}  // namespace zlg::cli
