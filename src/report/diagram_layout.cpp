#include "diagram_layout.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "text.hpp"

namespace zlg::report {
namespace {

constexpr double edge = 6.0;
constexpr double text_row_height = 20.0;
constexpr double box_air = 12.0;
constexpr double row_gap = 46.0;
constexpr double least_column_gap = 40.0;
constexpr double least_box_width = 40.0;
constexpr double least_box_height = 44.0;
constexpr double label_air = 6.0;
constexpr double head_room = 14.0;  // beside a label, for the arrow's head
constexpr int most_cells = 64;      // of the grid, to a side

int first_cell(int cell) { return std::clamp(cell, 0, most_cells - 1); }
int last_cell(int cell, int cells) { return std::clamp(first_cell(cell) + std::max(cells, 1) - 1, 0, most_cells - 1); }

double fitting_size(const std::string& text, double font_size, double room) {
    const double width = text_width(text, font_size);
    return width > room ? font_size * std::max(room, 1.0) / width : font_size;
}

// What two ranges have in common; empty where `first >= second`.
std::pair<double, double> common(double a0, double a1, double b0, double b1) {
    return {std::max(a0, b0), std::min(a1, b1)};
}

bool beside(const Box& a, const Box& b) {
    return last_cell(a.column, a.columns) < first_cell(b.column) ||
           last_cell(b.column, b.columns) < first_cell(a.column);
}

// The gap between columns holds the longest label that stands in it.
double column_gap(const Diagram& diagram, int n_columns) {
    double gap = least_column_gap;
    for (const Arrow& arrow : diagram.arrows) {
        if (arrow.from >= diagram.boxes.size() || arrow.to >= diagram.boxes.size()) continue;
        if (!beside(diagram.boxes[arrow.from], diagram.boxes[arrow.to])) continue;
        gap = std::max(gap, text_width(arrow.label, small_font_size) + head_room);
    }
    if (n_columns < 2) return gap;
    const double most = (figure_width - 2.0 * edge - n_columns * least_box_width) / (n_columns - 1);
    return std::clamp(gap, 0.0, std::max(most, 0.0));
}

struct Grid {
    double column_width = 0.0;
    double gap = 0.0;
    std::vector<double> top;  // of each row
    std::vector<double> bottom;

    [[nodiscard]] double left(int column) const { return edge + column * (column_width + gap); }
    [[nodiscard]] Rectangle rectangle(const Box& box) const {
        return {left(first_cell(box.column)), top[static_cast<std::size_t>(first_cell(box.row))],
                left(last_cell(box.column, box.columns)) + column_width,
                bottom[static_cast<std::size_t>(last_cell(box.row, box.rows))]};
    }
};

Grid grid_of(const Diagram& diagram) {
    int n_columns = 1;
    int n_rows = 1;
    for (const Box& box : diagram.boxes) {
        n_columns = std::max(n_columns, last_cell(box.column, box.columns) + 1);
        n_rows = std::max(n_rows, last_cell(box.row, box.rows) + 1);
    }
    Grid grid;
    grid.gap = column_gap(diagram, n_columns);
    grid.column_width = (figure_width - 2.0 * edge - (n_columns - 1) * grid.gap) / n_columns;
    std::vector<double> height(static_cast<std::size_t>(n_rows), least_box_height);
    for (const Box& box : diagram.boxes) {
        // A box over several rows shares its text out among them.
        const int cells = last_cell(box.row, box.rows) - first_cell(box.row) + 1;
        const double own = static_cast<double>(box.lines.size()) * text_row_height + 2.0 * box_air;
        double& row = height[static_cast<std::size_t>(first_cell(box.row))];
        row = std::max(row, (own - (cells - 1) * row_gap) / cells);
    }
    double y = edge;
    for (const double h : height) {
        grid.top.push_back(y);
        grid.bottom.push_back(y + h);
        y += h + row_gap;
    }
    return grid;
}

PlacedBox placed(const Box& box, const Rectangle& r) {
    PlacedBox out{r, {}, box.shaded};
    const double middle = 0.5 * (r.top + r.bottom);
    const double first = middle - 0.5 * text_row_height * (static_cast<double>(box.lines.size()) - 1.0) + 5.5;
    double size = small_font_size;
    for (const std::string& text : box.lines)
        size = std::min(size, fitting_size(text, small_font_size, r.right - r.left - 10.0));
    for (std::size_t i = 0; i < box.lines.size(); ++i)
        out.lines.push_back(
            {0.5 * (r.left + r.right), first + text_row_height * static_cast<double>(i), size, box.lines[i]});
    return out;
}

// Which of the arrows between the same two boxes this is, and of how many.
struct Share {
    int index = 0;
    int of = 0;

    [[nodiscard]] double between(const std::pair<double, double>& range) const {
        return range.first + (range.second - range.first) * (index + 1) / (of + 1);
    }
};

Share share_of(const Diagram& diagram, std::size_t which) {
    Share share;
    const auto pair = std::minmax(diagram.arrows[which].from, diagram.arrows[which].to);
    for (std::size_t i = 0; i < diagram.arrows.size(); ++i) {
        if (std::minmax(diagram.arrows[i].from, diagram.arrows[i].to) != pair) continue;
        if (i < which) ++share.index;
        ++share.of;
    }
    return share;
}

// The label stands to the right of the line; of several lines the first half have theirs to the left.
PlacedArrow upright(const Rectangle& from, const Rectangle& to, const std::pair<double, double>& range, Share share,
                    const std::string& label) {
    const double x = share.between(range);
    const bool down = to.top >= from.bottom;
    const double y0 = down ? from.bottom : from.top;
    const double y1 = down ? to.top : to.bottom;
    const bool left = 2 * share.index + 1 < share.of;
    const bool outermost = left ? share.index == 0 : share.index + 1 == share.of;
    const double spacing = (range.second - range.first) / (share.of + 1);
    const double free = left ? x - label_air : figure_width - x - label_air;
    // Beside the outermost line there is half a gap between columns more.
    const double room = std::min(outermost ? spacing + 0.5 * least_column_gap : spacing - label_air, free);
    const double size = fitting_size(label, small_font_size, room);
    const Line text{left ? x - label_air : x + label_air, 0.5 * (y0 + y1) + 5.0, size, label};
    return {{{x, y0}, {x, y1}}, text, left ? Anchor::end : Anchor::start, false};
}

PlacedArrow level(const Rectangle& from, const Rectangle& to, const std::pair<double, double>& range, Share share,
                  const std::string& label) {
    const double y = share.between(range);
    const bool right = to.left >= from.right;
    const double x0 = right ? from.right : from.left;
    const double x1 = right ? to.left : to.right;
    const double size = fitting_size(label, small_font_size, std::max(x0, x1) - std::min(x0, x1) - 4.0);
    return {{{x0, y}, {x1, y}}, {0.5 * (x0 + x1), y - label_air, size, label}, Anchor::middle, false};
}

PlacedArrow bent(const Rectangle& from, const Rectangle& to, const std::string& label) {
    const double y = 0.5 * (from.top + from.bottom);
    const double x = 0.5 * (to.left + to.right);
    const double x0 = to.left >= from.right ? from.right : from.left;
    const double y1 = to.top >= from.bottom ? to.top : to.bottom;
    const double size = fitting_size(label, small_font_size, std::max(x, x0) - std::min(x, x0) - 4.0);
    return {{{x0, y}, {x, y}, {x, y1}}, {0.5 * (x0 + x), y - label_air, size, label}, Anchor::middle, false};
}

std::optional<PlacedArrow> placed_arrow(const Diagram& diagram, std::size_t which,
                                        const std::vector<PlacedBox>& boxes) {
    const Arrow& arrow = diagram.arrows[which];
    if (arrow.from >= boxes.size() || arrow.to >= boxes.size() || arrow.from == arrow.to) return std::nullopt;
    const Rectangle& from = boxes[arrow.from].rectangle;
    const Rectangle& to = boxes[arrow.to].rectangle;
    const auto x = common(from.left, from.right, to.left, to.right);
    const auto y = common(from.top, from.bottom, to.top, to.bottom);
    const bool over = x.first < x.second;
    const bool next_to = y.first < y.second;
    if (over && next_to) return std::nullopt;
    const Share share = share_of(diagram, which);
    PlacedArrow out = over      ? upright(from, to, x, share, arrow.label)
                      : next_to ? level(from, to, y, share, arrow.label)
                                : bent(from, to, arrow.label);
    out.dashed = arrow.dashed;
    return out;
}

}  // namespace

DiagramLayout layout_of(const Diagram& diagram) {
    const Grid grid = grid_of(diagram);
    DiagramLayout out;
    out.height = grid.bottom.back() + edge;
    for (const Box& box : diagram.boxes) out.boxes.push_back(placed(box, grid.rectangle(box)));
    for (std::size_t i = 0; i < diagram.arrows.size(); ++i) {
        if (auto arrow = placed_arrow(diagram, i, out.boxes)) out.arrows.push_back(std::move(*arrow));
    }
    return out;
}

}  // namespace zlg::report
