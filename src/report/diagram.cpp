#include <zlg/report/diagram.hpp>

#include <fmt/format.h>

#include "drawing.hpp"
#include "text.hpp"

namespace zlg::report {
namespace {

static_assert(diagram_width == figure_width);

constexpr double row_height = 20.0;
constexpr double below_middle = 5.5;  // the foot of a letter whose middle stands on a line
constexpr double label_air = 6.0;
constexpr double head_length = 9.0;
constexpr double head_half_width = 4.5;

std::string drawn(const Box& box) {
    std::string out = fmt::format(
        "<rect class=\"box\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" rx=\"3\" fill=\"{}\" stroke=\"#444\" "
        "stroke-width=\"1.3\"/>\n",
        coordinate(box.left), coordinate(box.top), coordinate(box.width), coordinate(box.height),
        box.shaded ? "#dce9f3" : "#fff");
    double y = box.top + 0.5 * box.height + below_middle;
    y -= 0.5 * row_height * (static_cast<double>(box.lines.size()) - 1.0);
    for (const std::string& line : box.lines) {
        out += text_at({box.left + 0.5 * box.width, y, small_font_size, line}, "middle");
        y += row_height;
    }
    return out;
}

double sign(double x) { return x > 0.0 ? 1.0 : (x < 0.0 ? -1.0 : 0.0); }

// A head that needs no shared definition in the page.
std::string head_of(const Arrow& arrow) {
    const Place& end = arrow.to;
    const double dx = sign(end.x - arrow.from.x), dy = sign(end.y - arrow.from.y);
    const Place back{end.x - dx * head_length, end.y - dy * head_length};
    return fmt::format("<path class=\"head\" d=\"M{},{}L{},{}L{},{}z\" fill=\"#444\"/>\n", coordinate(end.x),
                       coordinate(end.y), coordinate(back.x + dy * head_half_width),
                       coordinate(back.y + dx * head_half_width), coordinate(back.x - dy * head_half_width),
                       coordinate(back.y - dx * head_half_width));
}

std::string label_of(const Arrow& arrow) {
    const double x = 0.5 * (arrow.from.x + arrow.to.x), y = 0.5 * (arrow.from.y + arrow.to.y);
    if (arrow.from.y == arrow.to.y) return text_at({x, y - label_air, small_font_size, arrow.label}, "middle");
    const double side = arrow.label_left ? -label_air : label_air;
    return text_at({x + side, y + below_middle, small_font_size, arrow.label}, arrow.label_left ? "end" : "start");
}

std::string drawn(const Arrow& arrow) {
    const std::string line =
        fmt::format("<path class=\"arrow\" d=\"M{},{}L{},{}\" fill=\"none\" stroke=\"#444\" stroke-width=\"1.5\"{}/>\n",
                    coordinate(arrow.from.x), coordinate(arrow.from.y), coordinate(arrow.to.x), coordinate(arrow.to.y),
                    arrow.dashed ? " stroke-dasharray=\"6 4\"" : "");
    return line + head_of(arrow) + (arrow.label.empty() ? "" : label_of(arrow));
}

}  // namespace

std::string svg(const Diagram& diagram) {
    std::string out = opening(clean_id(diagram.id, "diagram"), diagram.height, diagram.title, diagram.caption);
    for (const Box& box : diagram.boxes) out += drawn(box);
    for (const Arrow& arrow : diagram.arrows) out += drawn(arrow);
    return out + "</svg>\n";
}

}  // namespace zlg::report
