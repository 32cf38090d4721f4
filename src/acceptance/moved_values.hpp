#pragma once
// Values of runs in which something was done to the gyro: it was turned, warmed, or put into a magnetic field.

#include <string>
#include <vector>

#include <zlg/acceptance/quantity.hpp>
#include <zlg/report/figure.hpp>
#include <zlg/study/analyze.hpp>

#include "run_record.hpp"
#include "values.hpp"

namespace zlg::acceptance {

// Values, the figures that they rest on, and why a run is no measurement.
struct Found {
    std::vector<Value> values;
    std::vector<report::Figure> figures;
    std::string
        wrong_scale{};  // what a rate table says of the nominal scale that others rest on; empty: it bears it out
};

// Scale factor, nonlinearity, asymmetry, repeatability and threshold of rate tables, by calibration::rate_table.
//
// stops  of each record get a line where the table did not turn, or the gyro does not follow it.
[[nodiscard]] Found table_values(const Plan& plan, const std::vector<RunRecord*>& records,
                                 const config::Analysis& config);

// Bias against temperature, and its hysteresis; time from the start until the bias stays within the band of the plan.
[[nodiscard]] Found temperature_values(const std::vector<RunRecord*>& records);
[[nodiscard]] Found warm_up_values(const Plan& plan, const std::vector<RunRecord*>& records);

// Straight line of the bias over the field of each run.
[[nodiscard]] Found magnetic_values(const Plan& plan, const std::vector<StillAxis>& in_field);

}  // namespace zlg::acceptance
