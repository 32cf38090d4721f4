#pragma once
// Block diagrams as static SVG: boxes and arrows, where the drawing puts them.
//
// Places are in units of the viewBox: x to the right, y down. A drawing is `diagram_width` wide; letters are 16 units high.

#include <string>
#include <vector>

namespace zlg::report {

inline constexpr double diagram_width = 680.0;

struct Box {
    std::vector<std::string> lines;  // centred, 20 units from one to the next
    double left = 0.0;
    double top = 0.0;
    double width = 0.0;
    double height = 0.0;
    bool shaded = false;  // what that means stands in the caption
};

struct Place {
    double x = 0.0;
    double y = 0.0;
};

// A straight line with a head at its end, level or upright. The label stands above a level line, and to the right of an upright
// one or to its left.
struct Arrow {
    Place from;
    Place to;
    std::string label;
    bool label_left = false;
    bool dashed = false;
};

struct Diagram {
    std::string id;  // letters, digits and dashes
    std::string title;
    std::string caption;
    double height = 0.0;
    std::vector<Box> boxes;
    std::vector<Arrow> arrows;
};

// The diagram as an SVG element for an HTML page, as wide as a figure. All numbers of it are finite.
[[nodiscard]] std::string svg(const Diagram& diagram);

}  // namespace zlg::report
