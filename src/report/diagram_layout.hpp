#pragma once
// Where the boxes and arrows of a diagram stand, in units of the viewBox.

#include <vector>

#include <zlg/report/diagram.hpp>

#include "layout.hpp"

namespace zlg::report {

struct Place {
    double x = 0.0;
    double y = 0.0;
};

struct Rectangle {
    double left = 0.0;
    double top = 0.0;
    double right = 0.0;
    double bottom = 0.0;
};

struct PlacedBox {
    Rectangle rectangle;
    std::vector<Line> lines;  // centred on x
    bool shaded = false;
};

enum class Anchor { start, middle, end };

struct PlacedArrow {
    std::vector<Place> path;  // two places or more
    Line label;               // text empty: none
    Anchor anchor = Anchor::middle;
    bool dashed = false;
};

struct DiagramLayout {
    double height = 0.0;
    std::vector<PlacedBox> boxes;
    std::vector<PlacedArrow> arrows;
};

[[nodiscard]] DiagramLayout layout_of(const Diagram& diagram);

}  // namespace zlg::report
