#pragma once
// From what the logs hold to values with their errors: by the functions of `analyze` and `calibrate`.

#include <optional>
#include <string>
#include <vector>

#include <zlg/acceptance/quantity.hpp>
#include <zlg/study/analyze.hpp>
#include <zlg/study/calibrate.hpp>

#include "run_record.hpp"

namespace zlg::acceptance {

inline constexpr double z_95 = 1.6448536269514722;  // of 95 % of a normal law

// A record at rest, analysed.
struct StillAxis {
    const Run* run = nullptr;
    study::AxisResult result;
};

// Bias, its repeatability, and the terms of the noise of the longest record.
[[nodiscard]] std::vector<Value> still_values(const Plan& plan, const std::vector<StillAxis>& axes);

// The mean of one quantity over runs. Where they differ by more than their own noise explains (chi-square), their
// scatter is the error of the mean; else their noise is.
// One that is not determined leaves the mean open.
[[nodiscard]] Value together(const std::vector<Value>& runs);

// Standard deviation from run to run; `missing` says what fewer than two need.
[[nodiscard]] Value repeatability(std::string_view name, const std::vector<Value>& runs, const char* missing);

// The largest of one quantity over runs; one that is not determined leaves it open.
[[nodiscard]] Value largest(const std::vector<Value>& runs);

// Whether squared differences over their own variances, in sum, are more than chance gives with so many degrees of
// freedom (chi-square, 5 %).
[[nodiscard]] bool scatters(double squares, double degrees);

// Mean rate at rest, or non-magnetic drift, with what the noise lets it differ by.
[[nodiscard]] Value bias_of(const Plan& plan, const StillAxis& of);

// Where the mean rate is that of the Earth with the other sign: why the run tells nothing; else empty.
[[nodiscard]] std::string wrong_way(const Plan& plan, const StillAxis& axis);

[[nodiscard]] std::vector<Value> constant_values(const study::CalibrationResult& found);

// Of switches and alarms.
[[nodiscard]] std::vector<Value> switch_values(const std::vector<SwitchRecord>& logs,
                                               const std::vector<StillAxis>& axes);

}  // namespace zlg::acceptance
