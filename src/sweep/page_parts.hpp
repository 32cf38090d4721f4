#pragma once
// What the parts of the page of a sweep share.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <zlg/report/page.hpp>
#include <zlg/sweep/results.hpp>

namespace zlg::sweep {

inline constexpr int points_shown = 1000;  // of a curve

[[nodiscard]] std::string with_unit(const std::string& name, const std::string& unit);

// The good gyros, as columns.
struct Columns {
    std::vector<std::vector<double>> metrics;
    std::vector<std::string> names;  // of the parameters that are numbers
    std::vector<std::vector<double>> parameters;
};

[[nodiscard]] Columns columns_of(const Gyros& gyros, const Rows& rows);

// Whether there is anything to draw of a column.
[[nodiscard]] inline bool varies(const std::vector<double>& values) {
    return std::ranges::any_of(values, [&](double value) { return value != values.front(); });
}

// A limit that could be set, and the number of the good gyros that is held against it.
struct Limit {
    std::string label;
    double sign;    // passes where sign * value <= sign * limit
    double middle;  // of two limits, from which the distance counts
    bool is_distance;

    [[nodiscard]] double of(double value) const { return is_distance ? std::abs(value - middle) : value; }
};

[[nodiscard]] Limit limit_of(const Metric& m);

// Correlations.
[[nodiscard]] report::Section dependence(const Description& description, const Columns& columns);

}  // namespace zlg::sweep
