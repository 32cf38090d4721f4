#pragma once
// Block diagrams as static SVG: boxes on a grid, arrows between them.

#include <cstddef>
#include <string>
#include <vector>

namespace zlg::report {

struct Box {
    std::vector<std::string> lines;
    int column = 0;  // from the left, from 0
    int row = 0;     // from the top
    int columns = 1;
    int rows = 1;
    bool shaded = false;  // what that means stands in the caption
};

// Straight where the boxes face each other; several between the same two share that side. Otherwise along the row of
// `from`, then along the column of `to`. What stands in the way is not avoided.
struct Arrow {
    std::size_t from = 0;  // index of a box
    std::size_t to = 0;
    std::string label;
    bool dashed = false;
};

struct Diagram {
    std::string id;  // letters, digits and dashes
    std::string title;
    std::string caption;
    std::vector<Box> boxes;
    std::vector<Arrow> arrows;
};

// The diagram as an SVG element for an HTML page, as wide as a figure. An arrow from or to no box, to its own box or
// between boxes that overlap is not drawn.
[[nodiscard]] std::string svg(const Diagram& diagram);

}  // namespace zlg::report
