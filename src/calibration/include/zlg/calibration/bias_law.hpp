#pragma once
// Bias frequency of the settled gyro, and how it follows temperature.
//
//   (c_first - c_second) s / T = f0 (1 + alpha (T_c - T_ref))        s = bias_sign mode in the first half
//
// Means over segments. A gyro that hardly turns shows the same rounding tick after tick, one that turns by some counts
// runs through it, so segments are weighted by how far they turned; the standard errors come from their scatter.

#include <array>
#include <span>
#include <string>
#include <vector>

#include <zlg/calibration/lab_log.hpp>
#include <zlg/numeric/estimate.hpp>

namespace zlg::calibration {

// f0 at knots of temperature, straight between them, where one leaves the line by 4 standard errors.
struct BiasTable {
    std::vector<std::array<double, 2>> knots;  // C, and f0 there over bias_hz of the line, less 1
    std::vector<double> sigma;                 // one standard error of the latter, bias_hz being that number
    std::string reason = "the line of bias_temperature_coefficient_per_c holds within the errors";  // why none
};

struct BiasLaw {
    numeric::Estimate bias_hz;  // at the reference temperature
    numeric::Estimate temperature_coefficient_per_c;
    double coefficient_taken_per_c = 0.0;  // the one found, or the one presumed
    double reference_temperature_c = 20.0;
    double scatter_ratio = 0.0;  // rms of the segments about the law, over what rounding alone would leave
    std::int64_t dof = 0;
    BiasTable table;
    bool contradicts = false;  // counts, mode and bias_sign do not go together: nothing follows from them

    [[nodiscard]] double at_hz(double temperature_c) const;
    // Over 1 C, of a table within it: beyond its ends at_hz stands still, the gyro does not.
    [[nodiscard]] double slope_hz_per_c(double temperature_c) const;
};

// presumed_per_c  the coefficient where the data determine none.
[[nodiscard]] BiasLaw find_bias_law(std::span<const LabLog> logs, double reference_temperature_c,
                                    double presumed_per_c);

}  // namespace zlg::calibration
