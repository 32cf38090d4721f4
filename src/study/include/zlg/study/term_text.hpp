#pragma once
// A fitted term in the unit in which gyros are specified.

#include <string>

#include <zlg/noise/noise_fit.hpp>

namespace zlg::study {

struct ShownTerm {
    std::string unit;     // "deg/sqrt(h)", ...
    double factor = 1.0;  // from the unit of the kind to this one
    std::string second;   // what the second number is: "time", "frequency"; empty: there is none
    std::string second_unit;
};

[[nodiscard]] ShownTerm shown_term(noise::NoiseKind kind);

// "0.00234 +- 0.00002 deg/sqrt(h)", "below 0.03 deg/h", "not found"
[[nodiscard]] std::string value_text(const noise::FittedTerm& term);

// The value with as many digits as its error allows.
[[nodiscard]] std::string with_error(double value, double sigma);

}  // namespace zlg::study
