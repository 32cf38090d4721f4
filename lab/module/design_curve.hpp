#pragma once
// Apparent drift of a configured gyro over its switching interval, for a chart beside the gyro that runs.

#include <vector>

#include <zlg/config/config.hpp>

namespace zlg::lab {

// Rows of four: interval, s; drift as the paper's eq (7) has it, of the worst end of a run, and expected, arcsec/s (drift_budget.hpp).
//
// switch_error_arcsec  that one switch leaves.
// errors               design::DesignError where it, or the drift of the configuration, is out of range.
[[nodiscard]] std::vector<double> design_curve(const config::Config& config, double switch_error_arcsec, double run_s);

}  // namespace zlg::lab
