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

Box box(const std::string& text, double left, double top, double width = 100.0, double height = 64.0) {
    return {.lines = {text}, .left = left, .top = top, .width = width, .height = height};
}

Diagram diagram(std::vector<Box> boxes, std::vector<Arrow> arrows) {
    return {.id = "loop",
            .title = "Loop",
            .caption = "What goes where.",
            .height = 200.0,
            .boxes = std::move(boxes),
            .arrows = std::move(arrows)};
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
    Diagram d = diagram({box("Ring & <laser>", 6, 6), box("Detector", 200, 6)}, {});
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

TEST(Diagram, boxes_and_arrows_stand_where_they_are_put) {
    const auto all = markup::read(
        svg(diagram({box("a", 6, 6), box("b", 200, 30.5, 120, 70)}, {{.from = {106, 38}, .to = {200, 38}}})));
    EXPECT_EQ(all.front().attributes.at("viewBox"), "0 0 680 200");
    const auto b = boxes_of(all);
    EXPECT_EQ(b[1].left, 200.0);
    EXPECT_EQ(b[1].top, 30.5);
    EXPECT_EQ(b[1].right, 320.0);
    EXPECT_EQ(b[1].bottom, 100.5);
    const auto path = arrows_of(all).at(0);
    ASSERT_EQ(path.size(), 2U);
    EXPECT_EQ(path[0].x, 106.0);
    EXPECT_EQ(path[1].x, 200.0);
    EXPECT_EQ(path[1].y, 38.0);
}

TEST(Diagram, a_head_stands_at_the_end_of_its_arrow) {
    const auto all = markup::read(svg(diagram({}, {{.from = {100, 50}, .to = {200, 50}},
                                                   {.from = {200, 60}, .to = {100, 60}},
                                                   {.from = {50, 100}, .to = {50, 150}},
                                                   {.from = {60, 150}, .to = {60, 100}}})));
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

TEST(Diagram, a_label_stands_beside_the_middle_of_its_arrow) {
    const auto all =
        markup::read(svg(diagram({}, {{.from = {100, 50}, .to = {200, 50}, .label = "above"},
                                      {.from = {50, 100}, .to = {50, 150}, .label = "right"},
                                      {.from = {60, 150}, .to = {60, 100}, .label = "left", .label_left = true}})));
    const auto texts = markup::all(all, "text");
    ASSERT_EQ(texts.size(), 3U);
    EXPECT_EQ(texts[0].attributes.at("text-anchor"), "middle");
    EXPECT_EQ(markup::number(texts[0], "x"), 150.0);
    EXPECT_LT(markup::number(texts[0], "y"), 50.0);
    EXPECT_EQ(texts[1].attributes.at("text-anchor"), "start");
    EXPECT_GT(markup::number(texts[1], "x"), 50.0);
    EXPECT_EQ(texts[2].attributes.at("text-anchor"), "end");
    EXPECT_LT(markup::number(texts[2], "x"), 60.0);
}

TEST(Diagram, dashes_and_shades_say_what_the_caption_says) {
    Diagram d = diagram({box("a", 6, 6), box("b", 200, 6)},
                        {{.from = {106, 30}, .to = {200, 30}}, {.from = {200, 50}, .to = {106, 50}}});
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
