#include "axes_json.hpp"

#include <fmt/format.h>

#include "layout.hpp"
#include "text.hpp"

namespace zlg::report {
namespace {

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

}  // namespace zlg::report
