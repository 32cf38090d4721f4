#pragma once
// A drawing that never changes: an SVG file, as wide as a figure.

#include <string>

namespace zlg::report {

struct Diagram {
    std::string id;  // letters, digits and dashes; no other drawing of the page has it
    std::string title;
    std::string caption;
    std::string file;
};

// A drawing from the text of its file, whose first element has an id, a title and a description, without markup in
// them.
//
// errors  std::out_of_range for a text without one of them.
[[nodiscard]] Diagram diagram_of(std::string file);

// Its element alone, for an HTML page.
[[nodiscard]] std::string svg(const Diagram& diagram);

}  // namespace zlg::report
