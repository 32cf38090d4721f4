#include "marks.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include <fmt/format.h>

#include "text.hpp"

namespace zlg::report {
namespace {

constexpr const char* colours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#222222", "#56b4e9", "#e69f00"};
constexpr double line_width = 1.8;

// Places of consecutive points without a break between them.
using Run = std::vector<std::pair<double, double>>;

std::vector<Run> runs_of(const Series& series, const Layout& layout) {
    std::vector<Run> out(1);
    for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i) {
        if (layout.x.shows(series.x[i]) && layout.y.shows(series.y[i])) {
            out.back().emplace_back(layout.x.at(series.x[i]), layout.y.at(series.y[i]));
        } else if (!out.back().empty()) {
            // A step holds its value until the next x, even where a gap begins.
            const double held = out.back().back().second;
            if (series.mark == Mark::steps && layout.x.shows(series.x[i])) {
                out.back().emplace_back(layout.x.at(series.x[i]), held);
            }
            out.emplace_back();
        }
    }
    if (out.back().empty()) out.pop_back();
    return out;
}

std::string path_of(const Run& run, bool steps) {
    std::string out = fmt::format("M{},{}", coordinate(run.front().first), coordinate(run.front().second));
    for (std::size_t i = 1; i < run.size(); ++i) {
        const std::string x = coordinate(run[i].first);
        const std::string y = coordinate(run[i].second);
        out += steps ? fmt::format("H{}V{}", x, y) : fmt::format(" {},{}", x, y);
    }
    return out;
}

// A point alone between two breaks would be no line at all, so it is a dot.
std::string lines(const Series& series, std::size_t index, const Layout& layout) {
    std::string out;
    for (const Run& run : runs_of(series, layout)) {
        if (run.size() == 1) {
            out += marker(look_of(series, index), run.front().first, run.front().second, 3.0);
            continue;
        }
        out += fmt::format("<path d=\"{}\" fill=\"none\" stroke-width=\"{}\" stroke-linejoin=\"round\"{}/>\n",
                           path_of(run, series.mark == Mark::steps), line_width, dash_of(series, index));
    }
    return out;
}

std::string points(const Series& series, std::size_t index, const Layout& layout) {
    const double radius = series.x.size() > 150 ? 2.6 : 4.2;
    std::string out;
    for (const Run& run : runs_of(series, layout)) {
        for (const auto& [x, y] : run) out += marker(look_of(series, index), x, y, radius);
    }
    return out;
}

std::string bars(const Series& series, const Layout& layout) {
    const double half = bar_half_width(series, layout.x.log);
    const double base = layout.y.log ? layout.bottom : layout.y.at(0.0);
    std::string out;
    for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i) {
        if (!layout.x.shows(series.x[i]) || !layout.y.shows(series.y[i])) continue;
        const double centre = on_axis(series.x[i], layout.x.log);
        const double left = layout.x.at_axis(centre - half);
        const double width = std::max(layout.x.at_axis(centre + half) - left, 0.5);
        const double end = layout.y.at(series.y[i]);
        out += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill-opacity=\"0.55\"/>\n",
                           coordinate(left), coordinate(std::min(base, end)), coordinate(width),
                           coordinate(std::fabs(base - end)));
    }
    return out;
}

std::string error_bars(const Series& series, const Layout& layout) {
    const std::size_t n = std::min({series.x.size(), series.y.size(), series.y_error.size()});
    const double cap = n > 60 ? 0.0 : 4.0;
    std::string path;
    for (std::size_t i = 0; i < n; ++i) {
        const double error = std::fabs(series.y_error[i]);
        const double down = i < series.y_error_down.size() ? std::fabs(series.y_error_down[i]) : error;
        const bool has_bar = std::isfinite(error) && std::isfinite(down);
        if (!layout.x.shows(series.x[i]) || !layout.y.shows(series.y[i]) || !has_bar) continue;
        const double x = layout.x.at(series.x[i]);
        const std::string upper = coordinate(layout.y.at(series.y[i] + error));
        const std::string lower = coordinate(layout.y.at(series.y[i] - down));
        path += fmt::format("M{},{}V{}", coordinate(x), lower, upper);
        if (cap > 0.0)
            path += fmt::format("M{0},{2}H{1}M{0},{3}H{1}", coordinate(x - cap), coordinate(x + cap), lower, upper);
    }
    return path.empty() ? ""
                        : fmt::format("<path class=\"error\" d=\"{}\" fill=\"none\" stroke-width=\"1.3\"/>\n", path);
}

}  // namespace

const char* colour_of(std::size_t series) { return colours[series % std::size(colours)]; }

std::size_t look_of(const Series& series, std::size_t index) {
    return series.colour < 0 ? index : static_cast<std::size_t>(series.colour);
}

std::string dash_of(const Series& series, std::size_t index) {
    if (series.dashed) return " stroke-dasharray=\"9 5\"";
    return look_of(series, index) < std::size(colours) ? "" : " stroke-dasharray=\"2.5 3.5\"";
}

std::string marker(std::size_t series, double x, double y, double radius) {
    const auto r = [radius](double factor) { return coordinate(factor * radius); };
    const std::string at = fmt::format("<path d=\"M{},{}", coordinate(x), coordinate(y));
    switch (series % 4) {
        case 0: return fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\"/>\n", coordinate(x), coordinate(y), r(1.0));
        case 1: return fmt::format("{}m-{},-{}h{}v{}h-{}z\"/>\n", at, r(0.9), r(0.9), r(1.8), r(1.8), r(1.8));
        case 2: return fmt::format("{}m0,-{}l{},{}h-{}z\"/>\n", at, r(1.2), r(1.1), r(2.0), r(2.2));
        default: return fmt::format("{0}m0,-{1}l{1},{1}l-{1},{1}l-{1},-{1}z\"/>\n", at, r(1.3));
    }
}

std::string marks_of(const Series& series, std::size_t index, const Layout& layout) {
    std::string marks = error_bars(series, layout);
    switch (series.mark) {
        case Mark::points: marks += points(series, index, layout); break;
        case Mark::bars: marks += bars(series, layout); break;
        case Mark::line:
        case Mark::steps: marks += lines(series, index, layout); break;
    }
    if (marks.empty()) return "";
    return fmt::format("<g class=\"series\" stroke=\"{0}\" fill=\"{0}\">\n{1}</g>\n", colour_of(look_of(series, index)),
                       marks);
}

}  // namespace zlg::report
