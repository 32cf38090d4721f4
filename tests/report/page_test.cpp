#include <zlg/report/page.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <string>
#include <vector>

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

// The body is XML; the head has elements that HTML leaves open.
std::vector<markup::Element> body_of(const std::string& text) {
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
    for (const char* part : {"http", "//", "<script", "<link", "src=", "@import", "onload", "javascript"}) {
        EXPECT_EQ(text.find(part), std::string::npos) << part;
    }
    EXPECT_EQ(count(text, "url("), count(text, "url(#"));
}

TEST(Html, is_an_html5_page_with_language_charset_and_viewport) {
    const std::string text = html(page(1));
    EXPECT_EQ(text.rfind("<!DOCTYPE html>\n<html lang=\"en\">", 0), 0U);
    EXPECT_NE(text.find("<meta charset=\"utf-8\">"), std::string::npos);
    EXPECT_NE(text.find("<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"), std::string::npos);
    EXPECT_NE(text.find("<title>A run &lt;1&gt;</title>"), std::string::npos);
    EXPECT_NE(text.find("figure, tr, nav { break-inside: avoid; }"), std::string::npos);
}

TEST(Html, body_is_well_formed_and_text_is_escaped) {
    const auto body = body_of(html(page(2)));
    EXPECT_EQ(markup::all(body, "h1").at(0).text, "A run <1>");
    EXPECT_EQ(markup::all(body, "p").at(0).text, "Lead & more.");
    EXPECT_EQ(markup::all(body, "p").at(1).text, "One < two.");
    EXPECT_NO_THROW(body_of(html(Page{})));
}

TEST(Html, lists_contents_only_beyond_three_sections) {
    EXPECT_TRUE(markup::all(body_of(html(page(3))), "nav").empty());
    EXPECT_EQ(markup::all(body_of(html(page(3))), "li").size(), 0U);
    EXPECT_EQ(markup::all(body_of(html(page(4))), "li").size(), 4U);
}

TEST(Html, ids_are_unique_and_every_reference_resolves) {
    Page p = page(4);
    p.sections[1].figures = {figure(""), figure("section-1"), figure("a b\"c"), figure("figure-4")};
    std::set<std::string> ids;
    const auto body = body_of(html(p));
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
    const auto body = body_of(html(p));
    EXPECT_EQ(markup::all(body, "table", "scroll").size(), 1U);
    EXPECT_EQ(markup::all(body, "tr").size(), 4U);
    EXPECT_EQ(markup::all(body, "td").size(), 3U * 2U);
    EXPECT_EQ(markup::all(body, "th").size(), 3U + 3U);
}

TEST(Html, captions_are_numbered_and_stand_with_their_table_or_figure) {
    const auto body = body_of(html(page(2)));
    const auto captions = markup::all(body, "figcaption");
    ASSERT_EQ(captions.size(), 4U);
    const auto bold = markup::all(body, "b");
    EXPECT_EQ(bold.at(0).text, "Table 1.");
    EXPECT_EQ(bold.at(3).text, "Figure 2. Drift.");
    EXPECT_EQ(captions.at(1).text, " It falls.");
}

TEST(Html, an_empty_table_is_left_out) {
    Page p = page(0);
    p.sections = {{"S", {}, {Table{}}, {}}};
    EXPECT_TRUE(markup::all(body_of(html(p)), "figure").empty());
}

TEST(Html, diagrams_stand_before_the_figures_and_share_their_numbers_and_ids) {
    Page p = page(1);
    zlg::report::Diagram diagram;
    diagram.id = "drift";
    diagram.title = "Blocks";
    diagram.boxes.emplace_back();
    p.sections[0].diagrams = {diagram};
    const auto body = body_of(html(p));
    const auto drawings = markup::all(body, "svg");
    ASSERT_EQ(drawings.size(), 2U);
    EXPECT_NE(drawings[0].attributes.at("id"), drawings[1].attributes.at("id"));
    const auto bold = markup::all(body, "b");
    EXPECT_EQ(bold.at(1).text, "Figure 1. Blocks.");
    EXPECT_EQ(bold.at(2).text, "Figure 2. Drift.");
}

TEST(Html, leaves_the_numbers_to_titles_that_bring_their_own) {
    Page p = page(1);
    p.numbered = false;
    const auto body = body_of(html(p));
    EXPECT_EQ(markup::all(body, "b").at(0).text, "Drift.");
    EXPECT_EQ(markup::all(body, "figcaption").at(0).text, "Drift per mode.");
}

TEST(Html, only_a_table_of_prose_is_marked_as_such) {
    Page p = page(2);
    p.sections[1].tables[0].prose = true;
    const auto tables = markup::all(body_of(html(p)), "table");
    EXPECT_EQ(tables.at(0).attributes.count("class"), 0U);
    EXPECT_EQ(tables.at(1).attributes.at("class"), "prose");
}
