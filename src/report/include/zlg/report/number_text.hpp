#pragma once
// What the pages share: numbers in text, and a figure with its words and no curve yet.

#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <zlg/report/figure.hpp>

namespace zlg::report {

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

[[nodiscard]] inline Figure blank_figure(std::string id, std::string title, std::string caption, std::string x_label,
                                         std::string y_label) {
    Figure f;
    f.id = std::move(id);
    f.title = std::move(title);
    f.caption = std::move(caption);
    f.x_label = std::move(x_label);
    f.y_label = std::move(y_label);
    return f;
}

}  // namespace zlg::report
