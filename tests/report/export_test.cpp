#include <zlg/report/export.hpp>

#include "example_figures.hpp"
#include "markup.hpp"

using example::figure;
using example::not_a_number;
using example::series;
using zlg::report::csv;
using zlg::report::Figure;
using zlg::report::svg;
using zlg::report::svg_file;

namespace {

std::vector<std::string> lines_of(const std::string& text) {
    std::istringstream in{text};
    std::vector<std::string> out;
    for (std::string line; std::getline(in, line);) out.push_back(line);
    return out;
}

// The lines below the comments.
std::vector<std::string> body_of(const std::string& text) {
    std::vector<std::string> out;
    for (const std::string& line : lines_of(text))
        if (line.rfind('#', 0) != 0) out.push_back(line);
    return out;
}

// Without the declaration, which the small reader does not know.
std::string document_of(const std::string& text) { return text.substr(text.find('\n') + 1); }

}  // namespace

TEST(SvgFile, is_a_document_with_the_name_space_of_svg) {
    const std::string text = svg_file(figure({series({0.0, 1.0}, {2.0, 3.0})}));
    EXPECT_EQ(text.rfind("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg ", 0), 0U);
    const auto root = markup::read(document_of(text)).front();
    EXPECT_EQ(root.attributes.at("xmlns"), "http://www.w3.org/2000/svg");
    EXPECT_EQ(root.attributes.count("viewBox"), 1U);
}

TEST(SvgFile, shows_what_the_page_shows) {
    const Figure f = figure({series({0.0, 1.0}, {2.0, 3.0})});
    const auto alone = markup::read(document_of(svg_file(f)));
    const auto on_page = markup::read(svg(f));
    ASSERT_EQ(alone.size(), on_page.size());
    for (std::size_t i = 1; i < alone.size(); ++i) {
        EXPECT_EQ(alone[i].name, on_page[i].name);
        EXPECT_EQ(alone[i].attributes, on_page[i].attributes);
        EXPECT_EQ(alone[i].text, on_page[i].text);
    }
}

TEST(Csv, has_one_row_per_point_of_every_curve) {
    auto points = series({0.5}, {-2.5}, zlg::report::Mark::points);
    points.name = "twin";
    points.y_error = {0.25};
    EXPECT_EQ(body_of(csv(figure({series({0.0, 1.0}, {2.0, 3.0}), points}))),
              (std::vector<std::string>{"series,x,y,y_error", "measured,0,2,", "measured,1,3,", "twin,0.5,-2.5,0.25"}));
}

TEST(Csv, reals_read_back_to_the_same_double) {
    const std::vector<double> hard{0.1, 1.0 / 3.0, 1e-300, 12345678.9, -2.2250738585072014e-308};
    const auto rows = body_of(csv(figure({series(hard, hard)})));
    ASSERT_EQ(rows.size(), hard.size() + 1);
    for (std::size_t i = 0; i < hard.size(); ++i) {
        const auto first = rows[i + 1].find(',') + 1;
        EXPECT_EQ(std::stod(rows[i + 1].substr(first)), hard[i]) << rows[i + 1];
    }
}

TEST(Csv, a_point_that_is_no_number_stays_a_row) {
    EXPECT_EQ(body_of(csv(figure({series({0.0, 1.0, 2.0}, {2.0, not_a_number})}))),
              (std::vector<std::string>{"series,x,y,y_error", "measured,0,2,", "measured,1,nan,"}));
}

TEST(Csv, a_name_with_commas_and_quotes_is_one_field) {
    auto s = series({1.0}, {2.0});
    s.name = "3 sigma, \"white\"";
    EXPECT_EQ(body_of(csv(figure({s}))).at(1), "\"3 sigma, \"\"white\"\"\",1,2,");
}

TEST(Csv, comments_say_what_the_axes_are_and_stay_comments) {
    Figure f = figure({series({1.0}, {2.0})});
    f.caption = "One line,\nand what\r\nlooks like a row: 1,2";
    f.bands = {{1.0, 2.5, "gap"}};
    const auto lines = lines_of(csv(f));
    EXPECT_EQ(lines[0], "# figure: A test");
    EXPECT_EQ(lines[1].find("# caption: One line, and what"), 0U);
    EXPECT_EQ(lines[2], "# x: time, s");
    EXPECT_EQ(lines[3], "# y: angle, arcsec");
    EXPECT_EQ(lines[4], "# band: 1 to 2.5, gap");
    EXPECT_EQ(body_of(csv(f)).size(), 2U);
}

TEST(CsvQuoted, doubles_the_quotes_within) { EXPECT_EQ(zlg::report::csv_quoted("a \"b\", c"), "\"a \"\"b\"\", c\""); }
