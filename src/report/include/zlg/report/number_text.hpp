#pragma once
// What the pages share: numbers in text and in tables, and a figure with its words and no curve yet.

#include <cmath>
#include <concepts>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

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

[[nodiscard]] inline std::string cell(double x) { return short_number(x); }
[[nodiscard]] inline std::string cell(std::integral auto n) { return fmt::format("{}", n); }
[[nodiscard]] inline std::string cell(std::string_view text) { return std::string{text}; }

// A row of a table.
template <class... Cells> [[nodiscard]] std::vector<std::string> row(const Cells&... cells) { return {cell(cells)...}; }

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

[[nodiscard]] inline Series blank_series(std::string name, Mark mark = Mark::line, bool dashed = false,
                                         int colour = -1) {
    return {.name = std::move(name), .mark = mark, .dashed = dashed, .colour = colour};
}

inline void add_point(Series& series, double x, double y) {
    series.x.push_back(x);
    series.y.push_back(y);
}

}  // namespace zlg::report
