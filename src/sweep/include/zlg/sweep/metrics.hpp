#pragma once
// The numbers of a run's summary, by name.
//
// `configured.switch_error_rms_arcsec`: of a variant what `zlg run --json` says of it; likewise of magnetic_estimate.
// Without a point: of the whole run, as `switches_failed`. `relock_false_drift_deg_h.1`: of the first tick after
// closing, and so on.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <zlg/study/run.hpp>

namespace zlg::sweep {

[[nodiscard]] bool is_metric(std::string_view name);
[[nodiscard]] std::string nearest_metric(std::string_view name);
[[nodiscard]] const std::vector<std::string>& metric_names();

// The variant that must be computed for it; nothing where none but `configured` is.
[[nodiscard]] std::optional<std::string> variant_of(std::string_view metric);

// NaN where the run has none, as the error of a switch without a switch.
[[nodiscard]] double metric_of(const study::RunResult& result, std::string_view metric);

// By the end of its name: "arcsec/s", "deg/h", "arcsec", "s"; "1" for a number of things.
[[nodiscard]] std::string unit_of(std::string_view metric);

}  // namespace zlg::sweep
