#include "figure_values.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>

#include "layout.hpp"
#include "text.hpp"

namespace zlg::report {
namespace {

constexpr int most_rows = 200;  // of a figure

std::string json_string(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
    return out + "\"";
}

std::string axis_json(const Scale& scale, const std::string& label) {
    return fmt::format("[{:.9g},{:.9g},{:d},{}]", scale.limits.lo, scale.limits.hi, scale.log,
                       json_string(typeset(label)));
}

// A hyphen would be read as one; the script makes it one again in CSV.
std::string value(double x) {
    if (!std::isfinite(x)) return "";
    std::string text = fmt::format("{:.6g}", x);
    for (std::size_t at = text.find('-'); at != std::string::npos; at = text.find('-', at))
        text.replace(at, 1, "\u2212");
    return text;
}

std::string cell(std::string_view text) { return fmt::format("<td>{}</td>", text); }

std::string rows_of(const Series& series, bool has_error, bool has_down) {
    const std::string name = cell(escaped(typeset(series.name)));
    std::string out;
    for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i) {
        if (!std::isfinite(series.x[i]) || !std::isfinite(series.y[i])) continue;
        const bool known = i < series.y_error.size();
        std::string row = name + cell(value(series.x[i])) + cell(value(series.y[i]));
        if (has_error) row += cell(known ? value(series.y_error[i]) : "");
        if (has_down)
            row +=
                cell(known ? value(i < series.y_error_down.size() ? series.y_error_down[i] : series.y_error[i]) : "");
        out += "<tr>" + row + "</tr>\n";
    }
    return out;
}

}  // namespace

std::string axes_json(const Figure& figure) {
    const Layout layout = layout_of(figure);
    std::string series;
    for (const Series& s : figure.series)
        series += fmt::format("{}{{\"name\":{},\"drawn\":{}}}", series.empty() ? "" : ",", json_string(typeset(s.name)),
                              has_data(figure, s));
    return fmt::format("{{\"x\":{},\"y\":{},\"series\":[{}]}}", axis_json(layout.x, figure.x_label),
                       axis_json(layout.y, figure.y_label), series);
}

std::string values_table(const Figure& figure) {
    const auto any = [&](auto member) {
        return std::ranges::any_of(figure.series, [member](const Series& s) { return !(s.*member).empty(); });
    };
    const bool has_error = any(&Series::y_error), has_down = any(&Series::y_error_down);
    std::size_t n_drawn = 0, n_points = 0;
    for (const Series& s : figure.series) {
        if (!has_data(figure, s)) continue;
        ++n_drawn;
        n_points += std::min(s.x.size(), s.y.size());
    }
    if (n_drawn == 0) return "";
    std::string rows;
    for (const Series& s : figure.series)
        rows += rows_of(thin(s, most_rows / static_cast<int>(n_drawn)), has_error, has_down);
    return fmt::format(
        "<details class=\"values\"><summary>Values{}</summary><div class=\"scroll\" role=\"region\" tabindex=\"0\" "
        "aria-label=\"Values\">\n<table><thead><tr><th>series</th><th>{}</th><th>{}</th>{}{}</tr></thead><tbody>\n{}"
        "</tbody></table></div></details>\n",
        n_points > most_rows ? fmt::format(", thinned from {} points", n_points) : "", escaped(typeset(figure.x_label)),
        escaped(typeset(figure.y_label)), has_error ? has_down ? "<th>+</th>" : "<th>\u00B1</th>" : "",
        has_down ? "<th>\u2212</th>" : "", rows);
}

}  // namespace zlg::report
