#pragma once
// Figures as static SVG, from plain tables.

#include <string>
#include <vector>

namespace zlg::report {

// Steps hold the value of a point until the next x.
enum class Mark { line, points, steps, bars };

struct Series {
    std::string name;
    std::vector<double> x{};
    std::vector<double> y{};
    std::vector<double> y_error{};  // empty, or one half-length of the error bar per point
    Mark mark = Mark::line;
    bool dashed = false;
    int colour = -1;                     // that of the series with this index, and its marker; -1: its own
    std::vector<double> y_error_down{};  // where a bar reaches down otherwise than up: y_error is then the upper length
};

// A shaded stretch of the x axis, such as the ticks of a gap.
struct Band {
    double x0 = 0.0;
    double x1 = 0.0;
    std::string name;
};

struct Figure {
    std::string id;  // letters, digits and dashes
    std::string title;
    std::string caption;  // what the reader sees and what it means; plain text
    std::string x_label;  // quantity, unit
    std::string y_label;
    std::vector<Series> series{};
    std::vector<Band> bands{};
    bool log_x = false;
    bool log_y = false;
};

// The figure as an SVG element for an HTML page, scaling with it. Not-finite points, and those a log axis cannot show,
// break lines and are not drawn. Axes follow the data and its errors; bands are cut at the plot area.
[[nodiscard]] std::string svg(const Figure& figure);

// Thin a long series to at most `n_points`, keeping its ends and, of each stretch, the extremes and the first gap.
[[nodiscard]] Series thin(const Series& series, int n_points);

}  // namespace zlg::report
