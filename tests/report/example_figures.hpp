#pragma once
// Figures to draw in tests: one table, labels with units, nothing else.

#include <zlg/report/figure.hpp>

#include "test.hpp"

namespace example {

using zlg::report::Figure;
using zlg::report::Mark;
using zlg::report::Series;

inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
inline constexpr double infinity = std::numeric_limits<double>::infinity();

inline Series series(std::vector<double> x, std::vector<double> y, Mark mark = Mark::line) {
    Series out;
    out.name = "measured";
    out.x = std::move(x);
    out.y = std::move(y);
    out.mark = mark;
    return out;
}

inline Figure figure(std::vector<Series> all_series, bool log_x = false, bool log_y = false) {
    Figure out;
    out.id = "test";
    out.title = "A test";
    out.caption = "What is to see.";
    out.x_label = "time, s";
    out.y_label = "angle, arcsec";
    out.series = std::move(all_series);
    out.log_x = log_x;
    out.log_y = log_y;
    return out;
}

}  // namespace example
