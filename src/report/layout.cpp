#include "layout.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "text.hpp"

namespace zlg::report {
namespace {

constexpr double plot_height = 290.0;
constexpr double legend_row_height = 25.0;
constexpr double edge = 6.0;

Line fitted(double x, double y, double font_size, double room, std::string text) {
    const double width = text_width(text, font_size);
    return {x, y, width > room ? font_size * room / width : font_size, std::move(text)};
}

std::size_t n_points(const Series& series) { return std::min(series.x.size(), series.y.size()); }

bool drawable(const Figure& figure, const Series& series, std::size_t i) {
    return std::isfinite(on_axis(series.x[i], figure.log_x)) && std::isfinite(on_axis(series.y[i], figure.log_y));
}

// Points without a y count: a stretch without data is part of what the figure shows.
Extent x_extent(const Figure& figure) {
    Extent extent;
    for (const Series& s : figure.series) {
        for (std::size_t i = 0; i < n_points(s); ++i) extent.add(on_axis(s.x[i], figure.log_x));
    }
    if (extent.empty()) {
        for (const Band& band : figure.bands) {
            extent.add(on_axis(band.x0, figure.log_x));
            extent.add(on_axis(band.x1, figure.log_x));
        }
    }
    return extent;
}

// An error bar that reaches near zero or below runs out of a log axis; it must not stretch the axis with it.
void add_error(Extent& extent, double y, double up, double down, bool log) {
    if (!std::isfinite(up) || !std::isfinite(down)) return;
    extent.add(on_axis(y + up, log));
    if (!log || y - down > 0.1 * y) extent.add(on_axis(y - down, log));
}

Extent y_extent(const Figure& figure) {
    Extent extent;
    for (const Series& s : figure.series) {
        for (std::size_t i = 0; i < n_points(s); ++i) {
            if (!drawable(figure, s, i)) continue;
            extent.add(on_axis(s.y[i], figure.log_y));
            if (i >= s.y_error.size()) continue;
            const double up = std::fabs(s.y_error[i]);
            const double down = i < s.y_error_down.size() ? std::fabs(s.y_error_down[i]) : up;
            add_error(extent, s.y[i], up, down, figure.log_y);
        }
    }
    return extent;
}

double widest_label(const Ticks& ticks) {
    double width = 0.0;
    for (const Tick& tick : ticks.major) width = std::max(width, text_width(tick.label, tick_font_size));
    return width;
}

void place_x_axis(const Figure& figure, Layout& layout, double right) {
    layout.right = right;
    layout.x = {figure.log_x, limits(x_extent(figure), figure.log_x), layout.left, right};
    layout.x_ticks = ticks_of(layout.x, Side::bottom);
    if (layout.x_ticks.major.empty()) return;
    // The last label, centred on its tick, must not leave the page: then the axis ends a little earlier.
    const Tick& last = layout.x_ticks.major.back();
    const double beyond = last.at + 0.5 * text_width(last.label, tick_font_size) - figure_width;
    if (beyond > 0.0 && right > figure_width - 20.0) place_x_axis(figure, layout, right - beyond);
}

// Rows of the legend below `top`; returns the bottom.
double place_legend(const Figure& figure, Layout& layout, double top) {
    const double left = layout.left;
    const double room = figure_width - edge - left;
    double x = left;
    double baseline = top;
    for (std::size_t i = 0; i < figure.series.size(); ++i) {
        const Series& series = figure.series[i];
        if (series.name.empty()) continue;
        const std::string name = has_data(figure, series) ? series.name : series.name + " (no data)";
        const Line line = fitted(0.0, 0.0, small_font_size, room - swatch_width - 8.0, name);
        const double width = swatch_width + 8.0 + text_width(name, line.font_size);
        if (x > left && x + width > left + room) x = left;
        if (x == left) baseline += legend_row_height;
        layout.legend.push_back({{x, baseline, line.font_size, name}, i});
        x += width + 22.0;
    }
    return baseline;
}

}  // namespace

bool has_data(const Figure& figure, const Series& series) {
    for (std::size_t i = 0; i < n_points(series); ++i) {
        if (drawable(figure, series, i)) return true;
    }
    return false;
}

Layout layout_of(const Figure& figure) {
    Layout out;
    const bool named_bands =
        std::any_of(figure.bands.begin(), figure.bands.end(), [](const Band& b) { return !b.name.empty(); });
    out.top = named_bands ? 66.0 : 38.0;
    out.bottom = out.top + plot_height;
    out.y = {figure.log_y, limits(y_extent(figure), figure.log_y), out.bottom, out.top};
    out.y_ticks = ticks_of(out.y, Side::left);
    out.left = std::max(44.0, widest_label(out.y_ticks) + 18.0);
    place_x_axis(figure, out, figure_width - 18.0);
    const double room = figure_width - 2.0 * edge;
    out.y_label = fitted(edge, 20.0, label_font_size, room, figure.y_label);
    out.x_label =
        fitted(0.5 * (out.left + out.right), out.bottom + 48.0, label_font_size, out.right - out.left, figure.x_label);
    out.height = place_legend(figure, out, out.bottom + (figure.x_label.empty() ? 26.0 : 54.0)) + 12.0;
    if (named_bands) {
        out.band_names = place_band_names(figure.bands, out.x, out.left, figure_width - edge, out.top - 16.0);
    }
    return out;
}

}  // namespace zlg::report
