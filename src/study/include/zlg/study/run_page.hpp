#pragma once
// The report of a run, for an engineer who sees such a gyro for the first time.

#include <zlg/config/config.hpp>
#include <zlg/report/page.hpp>
#include <zlg/study/run.hpp>

namespace zlg::study {

// A row for each compensation; those whose figures are equal as shown share one.
[[nodiscard]] report::Table variant_table(const config::Config& config, const RunResult& result);

[[nodiscard]] report::Page run_page(const config::Config& config, const RunResult& result);

// The error of its angle over the time.
[[nodiscard]] report::Series curve_of(const VariantResult& variant, std::string name);

}  // namespace zlg::study
