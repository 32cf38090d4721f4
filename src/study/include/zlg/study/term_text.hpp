#pragma once
// Estimates as text, and a fitted term in the unit in which gyros are specified.

#include <string>
#include <string_view>

#include <zlg/noise/noise_fit.hpp>
#include <zlg/numeric/estimate.hpp>

namespace zlg::study {

struct ShownTerm {
    std::string unit;     // "deg/sqrt(h)", ...
    double factor = 1.0;  // from the unit of the kind to this one
    std::string second;   // what the second number is: "time", "frequency", "bandwidth"; empty: there is none
    std::string second_unit;
};

[[nodiscard]] ShownTerm shown_term(noise::NoiseKind kind);

// "0.00234 +- 0.00002 deg/sqrt(h)", "below 0.03 deg/h", "not found"
[[nodiscard]] std::string value_text(const noise::FittedTerm& term);

// "0.120 +- 0.013 deg/h", "not determined: the gyro is not switched"
[[nodiscard]] std::string value_text(const numeric::Estimate& estimate, std::string_view unit);

// The value with as many digits as its error allows.
[[nodiscard]] std::string with_error(double value, double sigma);

}  // namespace zlg::study
