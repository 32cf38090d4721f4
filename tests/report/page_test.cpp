#include <zlg/report/page.hpp>

#include "markup.hpp"

using zlg::report::Figure;
using zlg::report::html;
using zlg::report::Page;
using zlg::report::Section;
using zlg::report::Series;
using zlg::report::Table;

namespace {

Figure figure(const std::string& id) {
    Series line;
    line.name = "line";
    line.x = {0.0, 1.0};
    line.y = {2.0, 3.0};
    Figure out;
    out.id = id;
    out.title = "Drift";
    out.caption = "It falls.";
    out.series = {line};
    return out;
}

Page page(std::size_t n_sections) {
    Page out{"A run <1>", "Lead & more.", {}};
    for (std::size_t i = 0; i < n_sections; ++i) {
        const Table table{"Drift per mode.", {"mode", "drift, deg/h"}, {{"left", "0.01"}, {"right", "0.02"}}};
        out.sections.push_back({"Section " + std::to_string(i), {"One < two."}, {table}, {figure("drift")}});
    }
    return out;
}

// The body is XML; the head has elements that HTML leaves open. The script stands behind it.
std::vector<markup::Element> page_body(const std::string& text) {
    const std::size_t from = text.find("<body>");
    return markup::read(text.substr(from, text.find("</body>") + 7 - from));
}

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t n = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
    return n;
}

}  // namespace

TEST(Html, needs_nothing_from_outside) {
    std::string text = html(page(5));
    std::transform(text.begin(), text.end(), text.begin(),
                   [](char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); });
    for (const char* part :
         {"http", "//", "<script ", "<link", "src=", "@import", "onload", "javascript", "fetch", "import("}) {
        EXPECT_EQ(text.find(part), std::string::npos) << part;
    }
    EXPECT_EQ(count(text, "url("), count(text, "url(#"));
}

TEST(Html, is_an_html5_page_with_language_charset_and_viewport) {
    const std::string text = html(page(1));
    EXPECT_EQ(text.rfind("<!DOCTYPE html>\n<html lang=\"en\">", 0), 0U);
    zlg::test::expect_contains(text, "<meta charset=\"utf-8\">");
    zlg::test::expect_contains(text, "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">");
    zlg::test::expect_contains(text, "<title>A run &lt;1&gt;</title>");
    zlg::test::expect_contains(text, "figure, tr, nav, pre { break-inside: avoid; }");
}

TEST(Html, has_one_script_of_at_most_ten_kilobytes_after_all_that_is_read) {
    const std::string text = html(page(2));
    EXPECT_EQ(count(text, "<script>"), 1U);
    const std::size_t from = text.find("<script>") + 8, to = text.find("</script>");
    EXPECT_GT(from, text.find("</body>"));
    EXPECT_GT(to - from, 1000U);
    EXPECT_LE(to - from, 10'240U);
}

TEST(Html, every_colour_of_a_drawing_has_another_in_the_dark) {
    Page p = page(1);
    Figure& f = p.sections[0].figures[0];
    for (int i = 0; i < 9; ++i) {
        f.series.push_back(f.series[0]);
        f.series.back().mark = i % 2 == 0 ? zlg::report::Mark::points : zlg::report::Mark::line;
        f.series.back().y = {-1.0, 1.0};
    }
    f.bands = {{0.2, 0.4, "gap"}};
    p.sections[0].diagrams = {{.id = "d", .file = "<svg><rect fill=\"#dce9f3\" stroke=\"#444\"/></svg>"}};
    const std::string text = html(p);
    const std::string dark =
        text.substr(text.find("prefers-color-scheme"), text.find("</style>") - text.find("prefers-color-scheme"));
    std::set<std::string> seen;
    for (const auto& e : page_body(text))
        for (const char* key : {"fill", "stroke"})
            if (e.attributes.count(key) != 0 && e.attributes.at(key).front() == '#')
                seen.insert(std::string{"["} + key + "=\"" + e.attributes.at(key) + "\"]");
    EXPECT_GE(seen.size(), 16U);
    for (const std::string& colour : seen) EXPECT_NE(dark.find(colour), std::string::npos) << colour;
}

TEST(Html, the_verdict_is_read_first) {
    Page p = page(1);
    p.verdict = "It drifts by -1.5e-3 deg/h.";
    const auto paragraphs = markup::all(page_body(html(p)), "p");
    EXPECT_EQ(paragraphs.at(0).attributes.at("class"), "verdict");
    EXPECT_EQ(paragraphs.at(0).text, "It drifts by \u22121.5\u00D710\u207B\u00B3 deg/h.");
}

TEST(Html, columns_of_numbers_are_told_from_columns_of_text) {
    Page p = page(0);
    p.sections = {{"S",
                   {},
                   {{"C.",
                     {"a", "b", "c"},
                     {{"x", "-1.5e+03", "words enough to fill a line"}, {"y", "-", "4"}, {"z", "2 +- 1", "5"}}}},
                   {}}};
    const auto body = page_body(html(p));
    const auto cells = markup::all(body, "td");
    EXPECT_EQ(cells.at(0).attributes.at("class"), "n");
    EXPECT_EQ(cells.at(0).text, "\u22121.5\u00D710\u00B3");
    EXPECT_EQ(cells.at(1).attributes.count("class"), 0U);
    EXPECT_EQ(cells.at(1).attributes.at("data-is"), "c") << "stacked on a narrow screen, a cell names its column";
    EXPECT_EQ(cells.at(4).text, "2 \u00B1 1");
}

TEST(Html, the_script_is_told_the_axes_as_they_are_drawn) {
    Page p = page(1);
    Figure& f = p.sections[0].figures[0];
    f.series[0] = Series{.name = "a \"b\"", .x = {1.0, 100.0}, .y = {0.0, 1.0}};
    f.series.push_back({.name = "none"});
    f.log_y = false;
    f.x_label = "x, m";
    f.y_label = "y";
    for (const auto& e : page_body(html(p)))
        if (e.attributes.count("data-figure") != 0)
            EXPECT_EQ(e.attributes.at("data-figure"),
                      "{\"x\":[-2.96,103.96,0,\"x, m\"],\"y\":[-0.04,1.04,0,\"y\"],\"series\":[{\"name\":\"a "
                      "\\\"b\\\"\","
                      "\"drawn\":true},{\"name\":\"none\",\"drawn\":false}]}");
}

TEST(Html, body_is_well_formed_and_text_is_escaped) {
    const auto body = page_body(html(page(2)));
    EXPECT_EQ(markup::all(body, "h1").at(0).text, "A run <1>");
    EXPECT_EQ(markup::all(body, "p").at(0).text, "Lead & more.");
    EXPECT_EQ(markup::all(body, "p").at(2).text, "One < two.") << "behind the lead and the hint of the figures";
    EXPECT_NO_THROW(page_body(html(Page{})));
}

TEST(Html, ids_are_unique_and_every_reference_resolves) {
    Page p = page(4);
    p.sections[1].figures = {figure(""), figure("section-1"), figure("a b\"c"), figure("figure-4")};
    std::set<std::string> ids;
    const auto body = page_body(html(p));
    for (const auto& e : body) {
        if (e.attributes.count("id") == 0) continue;
        EXPECT_TRUE(ids.insert(e.attributes.at("id")).second) << e.attributes.at("id");
    }
    for (const auto& a : markup::all(body, "a")) {
        EXPECT_EQ(ids.count(a.attributes.at("href").substr(1)), 1U) << a.attributes.at("href");
    }
    for (const auto& e : body) {
        if (e.attributes.count("clip-path") == 0) continue;
        const std::string url = e.attributes.at("clip-path");
        EXPECT_EQ(ids.count(url.substr(5, url.size() - 6)), 1U) << url;
    }
}

TEST(Html, a_table_scrolls_in_its_own_box_and_ragged_rows_are_filled) {
    Page p = page(0);
    p.sections = {{"S", {}, {{"Caption.", {"a", "b"}, {{"1"}, {"1", "2", "3"}, {}}}}, {}}};
    const auto body = page_body(html(p));
    EXPECT_EQ(markup::all(body, "table", "scroll").size(), 1U);
    EXPECT_EQ(markup::all(body, "tr").size(), 4U);
    EXPECT_EQ(markup::all(body, "td").size(), 3U * 2U);
    EXPECT_EQ(markup::all(body, "th").size(), 3U + 3U);
}

TEST(Html, captions_are_numbered_and_stand_with_their_table_or_figure) {
    const auto body = page_body(html(page(2)));
    const auto captions = markup::all(body, "figcaption");
    ASSERT_EQ(captions.size(), 4U);
    const auto bold = markup::all(body, "b");
    EXPECT_EQ(bold.at(0).text, "Table 1.");
    EXPECT_EQ(bold.at(3).text, "Figure 2. Drift.");
    EXPECT_EQ(captions.at(1).text, " It falls.");
}
