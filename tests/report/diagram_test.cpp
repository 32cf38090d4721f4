#include <zlg/report/diagram.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "markup.hpp"

using zlg::report::Arrow;
using zlg::report::Box;
using zlg::report::Diagram;
using zlg::report::svg;

namespace {

struct Rectangle {
    double left, top, right, bottom;
};

struct Point {
    double x, y;
};

Box box(const std::string& text, int column, int row, int columns = 1, int rows = 1) {
    Box out;
    out.lines = {text};
    out.column = column;
    out.row = row;
    out.columns = columns;
    out.rows = rows;
    return out;
}

Diagram diagram(std::vector<Box> boxes, std::vector<Arrow> arrows) {
    Diagram out;
    out.id = "loop";
    out.title = "Loop";
    out.caption = "What goes where.";
    out.boxes = std::move(boxes);
    out.arrows = std::move(arrows);
    return out;
}

Arrow arrow(std::size_t from, std::size_t to, const std::string& label = "") {
    Arrow out;
    out.from = from;
    out.to = to;
    out.label = label;
    return out;
}

std::vector<markup::Element> all_of_class(const std::vector<markup::Element>& all, const std::string& name) {
    std::vector<markup::Element> out;
    for (const auto& e : all) {
        const auto found = e.attributes.find("class");
        if (found != e.attributes.end() && found->second == name) out.push_back(e);
    }
    return out;
}

std::vector<Rectangle> boxes_of(const std::vector<markup::Element>& all) {
    std::vector<Rectangle> out;
    for (const auto& e : all_of_class(all, "box")) {
        const double x = markup::number(e, "x");
        const double y = markup::number(e, "y");
        out.push_back({x, y, x + markup::number(e, "width"), y + markup::number(e, "height")});
    }
    return out;
}

// Places of a path of the form M x,y L x,y ...
std::vector<Point> path_of(const markup::Element& e) {
    std::string text = e.attributes.at("d");
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == 'M' || c == 'L' || c == ',' || c == 'z'; }, ' ');
    std::istringstream in{text};
    std::vector<Point> out;
    for (Point p{}; in >> p.x >> p.y;) out.push_back(p);
    return out;
}

std::vector<std::vector<Point>> arrows_of(const std::vector<markup::Element>& all) {
    std::vector<std::vector<Point>> out;
    for (const auto& e : all_of_class(all, "arrow")) out.push_back(path_of(e));
    return out;
}

}  // namespace

TEST(Diagram, every_box_holds_its_text) {
    Diagram d = diagram({box("Ring & <laser>", 0, 0), box("Detector", 1, 0)}, {});
    d.boxes[1].lines.push_back("and amplifier");
    const auto all = markup::read(svg(d));
    const auto boxes = boxes_of(all);
    const auto texts = markup::all(all, "text");
    ASSERT_EQ(boxes.size(), 2U);
    ASSERT_EQ(texts.size(), 3U);
    EXPECT_EQ(texts[0].text, "Ring & <laser>");
    EXPECT_EQ(texts[2].text, "and amplifier");
    for (std::size_t i = 0; i < texts.size(); ++i) {
        const Rectangle& r = boxes[i == 0 ? 0 : 1];
        EXPECT_DOUBLE_EQ(markup::number(texts[i], "x"), 0.5 * (r.left + r.right));
        EXPECT_GT(markup::number(texts[i], "y"), r.top);
        EXPECT_LT(markup::number(texts[i], "y"), r.bottom);
    }
    EXPECT_GT(markup::number(texts[2], "y") - markup::number(texts[1], "y"), markup::number(texts[1], "font-size"));
}

TEST(Diagram, text_too_long_for_its_box_gets_smaller) {
    const auto all = markup::read(svg(diagram({box(std::string(60, 'W'), 0, 0), box("short", 1, 0)}, {})));
    const auto boxes = boxes_of(all);
    const auto texts = markup::all(all, "text");
    // A wide character is not wider than its font is high.
    EXPECT_LE(0.6 * 60 * markup::number(texts[0], "font-size"), boxes[0].right - boxes[0].left);
    EXPECT_LT(markup::number(texts[0], "font-size"), markup::number(texts[1], "font-size"));
}

TEST(Diagram, boxes_stand_on_their_cells_and_within_the_page) {
    const auto all =
        markup::read(svg(diagram({box("a", 0, 0), box("b", 1, 0), box("c", 2, 0, 1, 2), box("d", 0, 1, 2)}, {})));
    const auto b = boxes_of(all);
    std::istringstream in{all.front().attributes.at("viewBox")};
    double x0 = 0.0, y0 = 0.0, width = 0.0, height = 0.0;
    in >> x0 >> y0 >> width >> height;
    for (const Rectangle& r : b) {
        EXPECT_GE(r.left, 0.0);
        EXPECT_LE(r.right, width);
        EXPECT_GE(r.top, 0.0);
        EXPECT_LE(r.bottom, height);
    }
    EXPECT_LT(b[0].right, b[1].left);
    EXPECT_LT(b[1].right, b[2].left);
    EXPECT_LT(b[0].bottom, b[3].top);
    EXPECT_EQ(b[2].top, b[0].top);
    EXPECT_EQ(b[2].bottom, b[3].bottom);
    EXPECT_EQ(b[3].left, b[0].left);
    EXPECT_EQ(b[3].right, b[1].right);
}

TEST(Diagram, an_arrow_goes_straight_from_edge_to_facing_edge) {
    const auto all = markup::read(
        svg(diagram({box("a", 0, 0), box("b", 1, 0), box("c", 0, 1)}, {arrow(0, 1), arrow(1, 0), arrow(2, 0)})));
    const auto b = boxes_of(all);
    const auto paths = arrows_of(all);
    ASSERT_EQ(paths.size(), 3U);
    EXPECT_EQ(paths[0].front().x, b[0].right);
    EXPECT_EQ(paths[0].back().x, b[1].left);
    EXPECT_EQ(paths[0].front().y, paths[0].back().y);
    EXPECT_EQ(paths[1].front().x, b[1].left);
    EXPECT_EQ(paths[1].back().x, b[0].right);
    EXPECT_NE(paths[0].front().y, paths[1].front().y) << "two arrows between the same boxes lie on each other";
    EXPECT_EQ(paths[2].front().y, b[2].top);
    EXPECT_EQ(paths[2].back().y, b[0].bottom);
    EXPECT_EQ(paths[2].front().x, paths[2].back().x);
}

TEST(Diagram, a_head_stands_at_the_end_of_its_arrow) {
    const auto all = markup::read(
        svg(diagram({box("a", 0, 0), box("b", 1, 0), box("c", 0, 1)}, {arrow(0, 1), arrow(1, 0), arrow(0, 2)})));
    const auto paths = arrows_of(all);
    const auto heads = all_of_class(all, "head");
    ASSERT_EQ(heads.size(), paths.size());
    for (std::size_t i = 0; i < heads.size(); ++i) {
        const auto head = path_of(heads[i]);
        const Point end = paths[i].back();
        EXPECT_EQ(head[0].x, end.x);
        EXPECT_EQ(head[0].y, end.y);
        // Its other corners lie back along the arrow, on either side.
        const Point start = paths[i].front();
        EXPECT_LT(std::hypot(head[1].x - start.x, head[1].y - start.y), std::hypot(end.x - start.x, end.y - start.y));
        const bool level = start.y == end.y;
        EXPECT_NEAR(level ? 0.5 * (head[1].y + head[2].y) : 0.5 * (head[1].x + head[2].x), level ? end.y : end.x, 0.01);
        EXPECT_EQ(level ? head[1].x : head[1].y, level ? head[2].x : head[2].y);
    }
}

TEST(Diagram, an_arrow_to_a_box_that_is_not_faced_bends_once) {
    const auto all = markup::read(svg(diagram({box("a", 0, 0), box("b", 2, 1)}, {arrow(0, 1)})));
    const auto b = boxes_of(all);
    const auto path = arrows_of(all).at(0);
    ASSERT_EQ(path.size(), 3U);
    EXPECT_EQ(path[0].x, b[0].right);
    EXPECT_EQ(path[0].y, path[1].y);
    EXPECT_NEAR(path[1].x, 0.5 * (b[1].left + b[1].right), 0.01);
    EXPECT_EQ(path[1].x, path[2].x);
    EXPECT_EQ(path[2].y, b[1].top);
}

TEST(Diagram, labels_of_two_arrows_side_by_side_do_not_meet) {
    const auto all =
        markup::read(svg(diagram({box("a", 0, 0), box("b", 0, 1)}, {arrow(0, 1, "up here"), arrow(1, 0, "down")})));
    const auto paths = arrows_of(all);
    const auto texts = markup::all(all, "text");
    EXPECT_EQ(texts[2].attributes.at("text-anchor"), "end");
    EXPECT_LT(markup::number(texts[2], "x"), paths[0].front().x);
    EXPECT_EQ(texts[3].attributes.at("text-anchor"), "start");
    EXPECT_GT(markup::number(texts[3], "x"), paths[1].front().x);
}

TEST(Diagram, the_gap_between_columns_holds_the_label) {
    const auto all = markup::read(svg(diagram({box("a", 0, 0), box("b", 1, 0)}, {arrow(0, 1, "a rather long label")})));
    const auto b = boxes_of(all);
    const auto text = markup::all(all, "text").back();
    EXPECT_EQ(text.text, "a rather long label");
    EXPECT_LE(0.6 * 19 * markup::number(text, "font-size"), b[1].left - b[0].right);
    EXPECT_NEAR(markup::number(text, "x"), 0.5 * (b[0].right + b[1].left), 0.01);
}

TEST(Diagram, what_cannot_be_drawn_is_left_out) {
    const auto all = markup::read(
        svg(diagram({box("a", 0, 0), box("b", 0, 0)}, {arrow(0, 7), arrow(7, 0), arrow(0, 0), arrow(0, 1)})));
    EXPECT_TRUE(arrows_of(all).empty());
    EXPECT_TRUE(markup::all(markup::read(svg(Diagram{})), "rect").empty());
}

TEST(Diagram, odd_numbers_make_no_odd_page) {
    for (const int n : {-5, 0, 1000000}) {
        const auto text = svg(diagram({box("a", n, n, n, n), box("b", 1, 1)}, {arrow(0, 1, "x")}));
        EXPECT_LT(text.size(), 20000U);
        for (const Rectangle& r : boxes_of(markup::read(text))) {
            EXPECT_TRUE(std::isfinite(r.left + r.top + r.right + r.bottom)) << n;
            EXPECT_GT(r.right, r.left) << n;
            EXPECT_GT(r.bottom, r.top) << n;
        }
    }
}

TEST(Diagram, dashes_and_shades_say_what_the_caption_says) {
    Diagram d = diagram({box("a", 0, 0), box("b", 1, 0)}, {arrow(0, 1), arrow(1, 0)});
    d.arrows[1].dashed = true;
    d.boxes[1].shaded = true;
    const auto all = markup::read(svg(d));
    const auto arrows = all_of_class(all, "arrow");
    EXPECT_EQ(arrows[0].attributes.count("stroke-dasharray"), 0U);
    EXPECT_EQ(arrows[1].attributes.count("stroke-dasharray"), 1U);
    const auto boxes = all_of_class(all, "box");
    EXPECT_NE(boxes[0].attributes.at("fill"), boxes[1].attributes.at("fill"));
    EXPECT_EQ(markup::all(all, "title").at(0).text, "Loop");
    EXPECT_EQ(markup::all(all, "desc").at(0).text, "What goes where.");
}
