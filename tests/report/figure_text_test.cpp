#include <zlg/report/figure.hpp>

#include <locale>

#include "example_figures.hpp"
#include "figure_reading.hpp"
#include "markup.hpp"

using example::figure;
using example::series;
using reading::label_value;
using reading::plot_of;
using reading::ticks_seen;
using reading::TickSeen;
using zlg::report::Figure;
using zlg::report::Mark;
using zlg::report::svg;

TEST(SvgText, the_legend_lies_below_the_plot_area) {
    Figure f = figure({});
    for (int i = 0; i < 9; ++i) {
        f.series.push_back(series({0, 1}, {1.0 * i, 2.0 * i}));
        f.series.back().name = "a rather long name of series " + std::to_string(i);
    }
    const auto elements = markup::read(svg(f));
    const auto names = markup::all(elements, "text", "legend");
    ASSERT_EQ(names.size(), 9U);
    const double height = std::stod(elements.front().attributes.at("viewBox").substr(8));
    for (const auto& name : names) {
        EXPECT_GT(markup::number(name, "y") - 16.0, plot_of(elements).bottom);
        EXPECT_LT(markup::number(name, "y"), height);
    }
}

TEST(SvgText, names_of_narrow_bands_do_not_overlap) {
    Figure f = figure({series({0, 100}, {0, 1})});
    for (int i = 0; i < 6; ++i) f.bands.push_back({50.0 + i, 50.4 + i, "band " + std::to_string(i)});
    const auto elements = markup::read(svg(f));
    const auto names = markup::all(elements, "text", "band-names");
    ASSERT_EQ(names.size(), 6U);
    const double width = 6 * 0.55 * markup::number(names[0], "font-size");
    for (std::size_t i = 0; i < names.size(); ++i) {
        EXPECT_LT(markup::number(names[i], "y"), plot_of(elements).top);
        EXPECT_LT(markup::number(names[i], "x") + 0.5 * width, 680.0);
        const double from_left = i == 0 ? 680.0 : markup::number(names[i], "x") - markup::number(names[i - 1], "x");
        EXPECT_GT(from_left, width);
    }
}

TEST(SvgText, names_of_bands_at_the_edges_stay_on_the_page) {
    Figure f = figure({series({0, 100}, {0, 1})});
    f.bands = {{0.0, 0.4, "a first long name"}, {1.0, 1.4, "a second long name"}, {99.0, 100.0, "the last name"}};
    const auto elements = markup::read(svg(f));
    const auto names = markup::all(elements, "text", "band-names");
    ASSERT_EQ(names.size(), 3U);
    for (const auto& name : names) {
        const double half = 0.5 * 0.55 * 16.0 * static_cast<double>(name.text.size());
        EXPECT_GT(markup::number(name, "x") - half, 0.0);
        EXPECT_LT(markup::number(name, "x") + half, 680.0);
    }
    EXPECT_GT(markup::number(names[1], "x") - markup::number(names[0], "x"), 17 * 0.55 * 16.0);
}

TEST(SvgText, text_comes_back_as_it_was_given) {
    Figure f = figure({series({0, 1}, {0, 1})});
    f.title = "a < b & \"c\" > 'd'";
    f.series[0].name = "<script>&amp;";
    f.y_label = "\u03B1 \xFF\x01";
    const auto elements = markup::read(svg(f));
    EXPECT_EQ(markup::all(elements, "title").at(0).text, f.title);
    EXPECT_EQ(markup::all(elements, "text", "legend").at(0).text, f.series[0].name);
    zlg::test::expect_contains(svg(f), "\u03B1 \uFFFD\uFFFD<");
}

TEST(SvgText, tells_a_reader_who_cannot_see_it) {
    const auto elements = markup::read(svg(figure({series({0, 1}, {0, 1})})));
    EXPECT_EQ(elements.at(0).attributes.at("role"), "img");
    EXPECT_EQ(elements.at(0).attributes.at("aria-labelledby"), "test-title test-desc");
    EXPECT_EQ(elements.at(1).attributes.at("id"), "test-title");
    EXPECT_EQ(elements.at(2).attributes.at("id"), "test-desc");
    EXPECT_EQ(elements.at(2).text, "What is to see. Horizontal axis: time, s. Vertical axis: angle, arcsec.");
}

TEST(SvgText, does_not_depend_on_the_locale) {
    struct Comma : std::numpunct<char> {
        char do_decimal_point() const override { return ','; }
        std::string do_grouping() const override { return "\3"; }
    };
    const Figure f = figure({series({0.25, 12345.5}, {0.125, 99999.0}, Mark::points)});
    const std::string before = svg(f);
    const std::locale old = std::locale::global(std::locale{std::locale{}, new Comma});
    const std::string after = svg(f);
    std::locale::global(old);
    EXPECT_EQ(before, after);
}
