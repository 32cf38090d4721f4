#include <zlg/report/number_text.hpp>

#include "example_figures.hpp"

namespace zlg::report::number_text_test {

using example::infinity;

TEST(NumberText, has_the_decimals_that_are_asked_for) {
    EXPECT_EQ(fixed_number(1.25, 3), "1.250");
    EXPECT_EQ(fixed_number(-17.0, 0), "-17");
}

TEST(NumberText, zero_has_no_sign) {
    EXPECT_EQ(fixed_number(-0.0004, 3), "0.000");
    EXPECT_EQ(fixed_number(-0.0006, 3), "-0.001");
}

TEST(NumberText, short_numbers_have_three_digits_and_all_of_the_whole_part) {
    EXPECT_EQ(short_number(0.0123456), "0.0123");
    EXPECT_EQ(short_number(123456.7), "123457");
    EXPECT_EQ(short_number(1.234e12), "1.23e+12");
}

TEST(NumberText, what_is_no_number_says_so) {
    EXPECT_EQ(fixed_number(infinity, 1), "none");
    EXPECT_EQ(short_number(std::numeric_limits<double>::quiet_NaN()), "none");
}

TEST(NumberText, a_row_has_short_numbers_whole_numbers_and_texts) {
    EXPECT_EQ(row(0.0123456, 123456, "text", infinity), (std::vector<std::string>{"0.0123", "123456", "text", "none"}));
}

TEST(NumberText, a_blank_series_takes_points) {
    Series series = blank_series("s", Mark::points, true);
    add_point(series, 1.0, 2.0);
    EXPECT_EQ(series.name, "s");
    EXPECT_EQ(series.mark, Mark::points);
    EXPECT_TRUE(series.dashed);
    EXPECT_EQ(series.x, std::vector{1.0});
    EXPECT_EQ(series.y, std::vector{2.0});
}

TEST(NumberText, a_blank_figure_has_its_words_and_no_curve) {
    const Figure figure = blank_figure("f", "title", "caption", "x", "y");
    EXPECT_EQ(figure.id, "f");
    EXPECT_EQ(figure.title, "title");
    EXPECT_EQ(figure.caption, "caption");
    EXPECT_EQ(figure.x_label, "x");
    EXPECT_EQ(figure.y_label, "y");
    EXPECT_TRUE(figure.series.empty());
}

}  // namespace zlg::report::number_text_test
