#include <zlg/report/diagram.hpp>

#include <algorithm>

#include <fmt/format.h>

#include "diagram_layout.hpp"
#include "drawing.hpp"
#include "text.hpp"

namespace zlg::report {
namespace {

constexpr double head_length = 9.0;
constexpr double head_half_width = 4.5;

std::string box(const PlacedBox& placed) {
    const Rectangle& r = placed.rectangle;
    std::string out = fmt::format(
        "<rect class=\"box\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" rx=\"3\" fill=\"{}\" stroke=\"#444\" "
        "stroke-width=\"1.3\"/>\n",
        coordinate(r.left), coordinate(r.top), coordinate(r.right - r.left), coordinate(r.bottom - r.top),
        placed.shaded ? "#dce9f3" : "#fff");
    for (const Line& line : placed.lines) out += text_at(line, "middle");
    return out;
}

// A head that points along the last stretch, so that it needs no shared definition in the page.
std::string head(const Place& before, const Place& end) {
    const double dx = end.x > before.x ? 1.0 : end.x < before.x ? -1.0 : 0.0;
    const double dy = end.y > before.y ? 1.0 : end.y < before.y ? -1.0 : 0.0;
    const double back_x = end.x - dx * head_length;
    const double back_y = end.y - dy * head_length;
    return fmt::format("<path class=\"head\" d=\"M{},{}L{},{}L{},{}z\" fill=\"#444\"/>\n", coordinate(end.x),
                       coordinate(end.y), coordinate(back_x + dy * head_half_width),
                       coordinate(back_y + dx * head_half_width), coordinate(back_x - dy * head_half_width),
                       coordinate(back_y - dx * head_half_width));
}

const char* anchor_name(Anchor anchor) {
    return anchor == Anchor::start ? "start" : anchor == Anchor::middle ? "middle" : "end";
}

std::string arrow(const PlacedArrow& placed) {
    std::string path;
    for (const Place& at : placed.path)
        path += fmt::format("{}{},{}", path.empty() ? 'M' : 'L', coordinate(at.x), coordinate(at.y));
    std::string out =
        fmt::format("<path class=\"arrow\" d=\"{}\" fill=\"none\" stroke=\"#444\" stroke-width=\"1.5\"{}/>\n", path,
                    placed.dashed ? " stroke-dasharray=\"6 4\"" : "");
    out += head(placed.path[placed.path.size() - 2], placed.path.back());
    if (!placed.label.text.empty()) out += text_at(placed.label, anchor_name(placed.anchor));
    return out;
}

}  // namespace

std::string svg(const Diagram& diagram) {
    const DiagramLayout layout = layout_of(diagram);
    std::string out = opening(clean_id(diagram.id, "diagram"), layout.height, diagram.title, diagram.caption);
    for (const PlacedBox& placed : layout.boxes) out += box(placed);
    for (const PlacedArrow& placed : layout.arrows) out += arrow(placed);
    return out + "</svg>\n";
}

}  // namespace zlg::report
