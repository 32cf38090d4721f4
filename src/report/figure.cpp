#include <zlg/report/figure.hpp>

#include <algorithm>

#include <fmt/format.h>

#include "layout.hpp"
#include "marks.hpp"
#include "text.hpp"

namespace zlg::report {
namespace {

// The opening tag of a drawing as wide as the page gives it, and what it says to those who cannot see it.
std::string opening(const std::string& id, double height, const std::string& title, const std::string& described) {
    return fmt::format(
        "<svg id=\"{0}\" class=\"figure\" viewBox=\"0 0 {1} {2}\" width=\"100%\" role=\"img\" "
        "aria-labelledby=\"{0}-title {0}-desc\" font-family=\"Helvetica, Arial, sans-serif\" fill=\"#111\">\n"
        "<title id=\"{0}-title\">{3}</title>\n<desc id=\"{0}-desc\">{4}</desc>\n",
        id, coordinate(figure_width), coordinate(height), escaped(typeset(title)), escaped(typeset(described)));
}

std::string text_at(const Line& line, const char* anchor) {
    return fmt::format("<text x=\"{}\" y=\"{}\" font-size=\"{}\" text-anchor=\"{}\">{}</text>\n", coordinate(line.x),
                       coordinate(line.y), coordinate(line.font_size), anchor, escaped(typeset(line.text)));
}

std::string described(const Figure& figure) {
    std::string out = figure.caption;
    if (!figure.x_label.empty()) out += " Horizontal axis: " + figure.x_label + ".";
    if (!figure.y_label.empty()) out += " Vertical axis: " + figure.y_label + ".";
    return out;
}

std::string plot_rectangle(const Layout& layout) {
    return fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"", coordinate(layout.left),
                       coordinate(layout.top), coordinate(layout.right - layout.left),
                       coordinate(layout.bottom - layout.top));
}

// Neighbouring bands get different greys, so that their border is seen.
std::string bands(const Figure& figure, const Layout& layout) {
    std::string out;
    bool dark = false;
    for (const Band& band : figure.bands) {
        if (!band_visible(band, layout.x)) continue;
        const double from = layout.x.at(std::min(band.x0, band.x1));
        const double width = std::max(layout.x.at(std::max(band.x0, band.x1)) - from, 1.5);
        out += fmt::format(
            "<rect class=\"band\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" "
            "fill-opacity=\"{}\"><title>{}</title></rect>\n",
            coordinate(from), coordinate(layout.top), coordinate(width), coordinate(layout.bottom - layout.top),
            dark ? "0.15" : "0.09", escaped(band.name));
        dark = !dark;
    }
    return out;
}

std::string across(const Layout& layout, double y) {
    return fmt::format("M{},{}H{}", coordinate(layout.left), coordinate(y), coordinate(layout.right));
}

std::string upright(const Layout& layout, double x) {
    return fmt::format("M{},{}V{}", coordinate(x), coordinate(layout.top), coordinate(layout.bottom));
}

std::string stroke_path(const std::string& path, const char* colour) {
    return path.empty() ? "" : fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\"/>\n", path, colour);
}

std::string grid(const Layout& layout) {
    std::string fine;
    for (const double x : layout.x_ticks.minor) fine += upright(layout, x);
    for (const double y : layout.y_ticks.minor) fine += across(layout, y);
    std::string coarse;
    for (const Tick& tick : layout.x_ticks.major) coarse += upright(layout, tick.at);
    for (const Tick& tick : layout.y_ticks.major) coarse += across(layout, tick.at);
    const Scale& y = layout.y;
    const bool crosses_zero = !y.log && y.limits.lo < 0.0 && y.limits.hi > 0.0;
    return stroke_path(fine, "#eee") + stroke_path(coarse, "#d4d4d4") +
           stroke_path(crosses_zero ? across(layout, y.at(0.0)) : "", "#888");
}

std::string axes(const Layout& layout) {
    std::string path;
    std::string x_labels;
    std::string y_labels;
    for (const Tick& tick : layout.x_ticks.major) {
        path += fmt::format("M{},{}v6", coordinate(tick.at), coordinate(layout.bottom));
        x_labels += text_at({tick.at, layout.bottom + 23.0, tick_font_size, tick.label}, "middle");
    }
    for (const Tick& tick : layout.y_ticks.major) {
        path += fmt::format("M{},{}h-6", coordinate(layout.left), coordinate(tick.at));
        y_labels += text_at({layout.left - 10.0, tick.at + 5.5, tick_font_size, tick.label}, "end");
    }
    return plot_rectangle(layout) + " class=\"plot\" fill=\"none\" stroke=\"#444\"/>\n" + stroke_path(path, "#444") +
           "<g class=\"x-ticks\">\n" + x_labels + "</g>\n<g class=\"y-ticks\">\n" + y_labels + "</g>\n";
}

std::string band_names(const Layout& layout) {
    std::string out;
    std::string ties;
    for (const BandName& name : layout.band_names) {
        out += text_at(name.line, "middle");
        ties += fmt::format("M{},{}L{},{}", coordinate(name.line.x), coordinate(name.line.y + 4.0),
                            coordinate(name.band_centre), coordinate(layout.top));
    }
    return out.empty() ? "" : "<g class=\"band-names\">\n" + out + "</g>\n" + stroke_path(ties, "#888");
}

std::string swatch(const Series& series, const LegendEntry& entry) {
    const double middle = entry.line.y - 5.5;
    const double x = entry.line.x;
    switch (series.mark) {
        case Mark::points: return marker(look_of(series, entry.series), x + 0.5 * swatch_width, middle, 4.2);
        case Mark::bars:
            return fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"12\" fill-opacity=\"0.55\"/>\n",
                               coordinate(x), coordinate(middle - 6.0), coordinate(swatch_width));
        case Mark::line:
        case Mark::steps: break;
    }
    return fmt::format("<path d=\"M{},{}h{}\" stroke-width=\"2.4\"{}/>\n", coordinate(x), coordinate(middle),
                       coordinate(swatch_width), dash_of(series, entry.series));
}

std::string legend(const Figure& figure, const Layout& layout) {
    std::string out;
    for (const LegendEntry& entry : layout.legend) {
        Line name = entry.line;
        name.x += swatch_width + 8.0;
        out += fmt::format("<g stroke=\"{0}\" fill=\"{0}\">{1}</g>{2}",
                           colour_of(look_of(figure.series[entry.series], entry.series)),
                           swatch(figure.series[entry.series], entry), text_at(name, "start"));
    }
    return out.empty() ? "" : "<g class=\"legend\">\n" + out + "</g>\n";
}

std::string data(const Figure& figure, const Layout& layout, const std::string& id) {
    std::string out;
    for (std::size_t i = 0; i < figure.series.size(); ++i) out += marks_of(figure.series[i], i, layout);
    if (out.empty()) {
        return text_at(
            {0.5 * (layout.left + layout.right), 0.5 * (layout.top + layout.bottom), label_font_size, "no data"},
            "middle");
    }
    return fmt::format("<clipPath id=\"{0}-plot\">{1}/></clipPath>\n<g clip-path=\"url(#{0}-plot)\">\n{2}</g>\n", id,
                       plot_rectangle(layout), out);
}

}  // namespace

std::string svg(const Figure& figure) {
    const Layout layout = layout_of(figure);
    const std::string id = clean_id(figure.id, "figure");
    return opening(id, layout.height, figure.title, described(figure)) + bands(figure, layout) + grid(layout) +
           data(figure, layout, id) + axes(layout) + band_names(layout) + text_at(layout.y_label, "start") +
           text_at(layout.x_label, "middle") + legend(figure, layout) + "</svg>\n";
}

}  // namespace zlg::report
