#include "drawing.hpp"

#include <fmt/format.h>

#include "text.hpp"

namespace zlg::report {

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

}  // namespace zlg::report
