#pragma once
// Numbers in the text of the recomputed paper.

#include <cmath>
#include <string>

#include <fmt/format.h>

namespace zlg::study {

// Of a number that does not exist.
inline constexpr const char* no_number = "none";

[[nodiscard]] inline std::string fixed_number(double x, int decimals) {
    if (!std::isfinite(x)) return no_number;
    std::string text = fmt::format("{:.{}f}", x, decimals);
    const bool minus_zero = text.front() == '-' && text.find_first_not_of("-0.") == std::string::npos;
    return minus_zero ? text.substr(1) : text;
}

// Three significant digits are what a reader compares.
[[nodiscard]] inline std::string short_number(double x) {
    if (!std::isfinite(x)) return no_number;
    return std::abs(x) >= 1000.0 && std::abs(x) < 1e9 ? fmt::format("{:.0f}", x) : fmt::format("{:.3g}", x);
}

}  // namespace zlg::study
