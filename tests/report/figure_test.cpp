#include <zlg/report/figure.hpp>

#include "example_figures.hpp"
#include "figure_reading.hpp"
#include "markup.hpp"

using example::figure;
using example::infinity;
using example::not_a_number;
using example::series;
using reading::Frame;
using reading::is_round;
using reading::plot_of;
using reading::read_off;
using reading::ticks_seen;
using reading::TickSeen;
using zlg::report::Figure;
using zlg::report::Mark;
using zlg::report::Series;
using zlg::report::svg;

namespace {

std::vector<Figure> odd_figures() {
    std::vector<Figure> out{
        figure({}),
        figure({series({}, {})}),
        figure({series({5.0}, {3.0})}),
        figure({series({1.0, 2.0}, {4.0, 4.0})}),
        figure({series({0.0, 0.0}, {0.0, 0.0})}),
        figure({series({1.0, 2.0}, {not_a_number, infinity})}),
        figure({series({not_a_number, infinity}, {1.0, 2.0}, Mark::points)}, true, true),
        figure({series({-1e308, 1e308}, {1e-310, 2e-300}), series({0.0}, {1e308}, Mark::points)}),
        figure({series({1e-310, 1e308}, {4.9e-324, 1.7e308})}, true, true),
        figure({series({1e-310, 1e308}, {1e-322, 1e-322})}, true, true),
        figure({series({-1.0, 0.0}, {0.0, -1.0})}, true, true),
        figure({series({1e12, 1e12 + 1e-3}, {1.0, 1.0 + 1e-15})}),
        figure({series({1.0, 1.0 + 1e-6}, {1.0, 1.0 + 1e-7})}, true, true),
        figure({series({1.0, 2.0, 3.0}, {1.0})}),
        figure({series({1e-320, 3e-320}, {1e-310, 3e-310})}),
        figure({series({1.0, 2.0}, {-3.0, 2.0}, Mark::steps)}),
    };
    Figure full = out.back();
    full.series.front().y_error = {not_a_number, infinity};
    full.bands = {
        {-infinity, infinity, "all"}, {not_a_number, 1.0, "none"}, {1.2, 1.1, "turned"}, {7.0, 8.0, "outside"}};
    out.push_back(full);
    for (Figure& f : out) {
        f.bands.push_back({0.0, 1.0, "band"});
    }
    return out;
}

}  // namespace

TEST(Svg, of_every_odd_input_is_well_formed_and_has_ticks_and_no_number_that_is_none) {
    for (const Figure& f : odd_figures()) {
        const std::string out = svg(f);
        SCOPED_TRACE(out);
        const auto elements = markup::read(out);
        EXPECT_GE(markup::all(elements, "text", "x-ticks").size(), 2U);
        EXPECT_GE(markup::all(elements, "text", "y-ticks").size(), 2U);
        EXPECT_EQ(out.find("nan"), std::string::npos);
        EXPECT_EQ(out.find("inf"), std::string::npos);
    }
}

TEST(Svg, linear_ticks_are_round_evenly_spaced_and_inside) {
    for (const double span : {1e-7, 0.00123, 0.9, 7.0, 33.0, 700.0, 123456.0, 8.8e9}) {
        for (const double from : {0.0, -0.3, 1.7}) {
            const auto elements = markup::read(svg(figure({series({from * span, (from + 1.0) * span}, {0.0, span})})));
            const Frame plot = plot_of(elements);
            const auto x = ticks_seen(elements, "x-ticks");
            const auto y = ticks_seen(elements, "y-ticks");
            ASSERT_GE(x.size(), 3U);
            ASSERT_GE(y.size(), 4U);
            EXPECT_TRUE(is_round(x[1].value - x[0].value)) << x[1].value - x[0].value;
            EXPECT_TRUE(is_round(y[1].value - y[0].value)) << y[1].value - y[0].value;
            for (std::size_t i = 0; i < x.size(); ++i) {
                EXPECT_NEAR(x[i].value, x[0].value + static_cast<double>(i) * (x[1].value - x[0].value), 1e-9 * span);
                EXPECT_TRUE(x[i].at >= plot.left && x[i].at <= plot.right);
            }
            for (const TickSeen& tick : y) EXPECT_TRUE(tick.at >= plot.top && tick.at <= plot.bottom);
        }
    }
}

TEST(Svg, a_point_is_read_off_the_axes_as_its_value) {
    const auto read = [](const Series& data, bool is_log, auto expect) {
        const auto elements = markup::read(svg(figure({data}, is_log, is_log)));
        const auto circles = markup::all(elements, "circle", "series");
        ASSERT_EQ(circles.size(), 4U);
        for (std::size_t i = 0; i < 4; ++i)
            expect(read_off(ticks_seen(elements, "x-ticks"), markup::number(circles[i], "cx"), is_log), data.x[i],
                   read_off(ticks_seen(elements, "y-ticks"), markup::number(circles[i], "cy"), is_log), data.y[i]);
    };
    read(series({0.0, 131.7, 402.5, 699.0}, {-0.0031, 0.0007, 0.00219, 0.0044}, Mark::points), false,
         [](double x, double true_x, double y, double true_y) {
             EXPECT_NEAR(x, true_x, 0.05);
             EXPECT_NEAR(y, true_y, 1e-6);
         });
    read(series({0.002, 0.31, 44.0, 7000.0}, {3e-7, 8e-6, 5.5e-4, 0.91}, Mark::points), true,
         [](double x, double true_x, double y, double true_y) {
             EXPECT_NEAR(x / true_x, 1.0, 2e-3);
             EXPECT_NEAR(y / true_y, 1.0, 2e-3);
         });
}

TEST(Svg, the_last_tick_label_stays_on_the_page) {
    const auto elements = markup::read(svg(figure({series({1234551, 1234579.2}, {0, 1})})));
    const auto last = markup::all(elements, "text", "x-ticks").back();
    EXPECT_EQ(last.text, "1\u00A0234\u00A0580");
    EXPECT_LE(markup::number(last, "x") + 0.5 * 9 * 0.55 * 16.0, 680.0);
}

TEST(Svg, decades_are_whole_powers_of_ten) {
    const auto elements = markup::read(svg(figure({series({1e-5, 2e4}, {1e-12, 1e13})}, true, true)));
    for (const std::string group : {"x-ticks", "y-ticks"}) {
        for (const TickSeen& tick : ticks_seen(elements, group)) {
            EXPECT_NEAR(std::log10(tick.value), std::round(std::log10(tick.value)), 1e-9);
        }
    }
}

TEST(Svg, log_axes_leave_out_what_is_not_positive) {
    const Series data = series({-1.0, 0.0, 1.0, 10.0, 100.0}, {1.0, 1.0, 0.0, 2.0, 3.0}, Mark::points);
    EXPECT_EQ(markup::all(markup::read(svg(figure({data}, true, true))), "circle", "series").size(), 2U);
}

TEST(Svg, every_finite_point_lies_in_the_plot_area) {
    for (const bool log : {false, true}) {
        Series data = series({}, {}, Mark::points);
        for (int i = 1; i <= 60; ++i) {
            data.x.push_back(std::exp(0.37 * i));
            data.y.push_back(i % 7 == 0 ? not_a_number : std::exp(0.2 * i) * (1.5 + std::sin(i)));
        }
        const auto elements = markup::read(svg(figure({data}, log, log)));
        const Frame plot = plot_of(elements);
        const auto circles = markup::all(elements, "circle", "series");
        EXPECT_EQ(circles.size(), 60U - 8U);
        for (const auto& circle : circles) {
            EXPECT_GT(markup::number(circle, "cx"), plot.left);
            EXPECT_LT(markup::number(circle, "cx"), plot.right);
            EXPECT_GT(markup::number(circle, "cy"), plot.top);
            EXPECT_LT(markup::number(circle, "cy"), plot.bottom);
        }
    }
}

TEST(Svg, a_point_that_is_not_finite_breaks_the_line) {
    const auto whole = markup::read(svg(figure({series({0, 1, 2, 3, 4}, {1, 2, 3, 2, 1})})));
    const auto broken = markup::read(svg(figure({series({0, 1, 2, 3, 4}, {1, 2, not_a_number, 2, 1})})));
    EXPECT_EQ(markup::all(whole, "path", "series").size(), 1U);
    EXPECT_EQ(markup::all(broken, "path", "series").size(), 2U);
}

TEST(Svg, a_point_alone_between_breaks_is_still_seen) {
    const auto elements = markup::read(svg(figure({series({0, 1, 2}, {infinity, 2, not_a_number})})));
    EXPECT_EQ(markup::all(elements, "circle", "series").size(), 1U);
}

TEST(Svg, a_step_holds_its_value_until_the_next_x) {
    const auto elements = markup::read(svg(figure({series({0, 1, 2}, {5, 7, not_a_number}, Mark::steps)})));
    const std::string path = markup::all(elements, "path", "series").at(0).attributes.at("d");
    const auto x = ticks_seen(elements, "x-ticks");
    const double at_two = std::stod(path.substr(path.rfind('H') + 1));
    const double at_seven = std::stod(path.substr(path.rfind('V') + 1));
    EXPECT_NEAR(read_off(x, at_two, false), 2.0, 0.01);
    EXPECT_NEAR(read_off(ticks_seen(elements, "y-ticks"), at_seven, false), 7.0, 0.01);
}

TEST(Svg, error_bars_reach_one_error_to_each_side_or_down_otherwise_than_up) {
    for (const bool other_down : {false, true}) {
        Series data = series({0, 1}, {10, 5}, Mark::points);
        data.y_error = {4.0, not_a_number};
        if (other_down) data.y_error_down = {2.0, 1.0};
        const auto elements = markup::read(svg(figure({data})));
        const std::string path = markup::of_class(elements, "error").attributes.at("d");
        const auto y = ticks_seen(elements, "y-ticks");
        EXPECT_NEAR(read_off(y, std::stod(path.substr(path.find(',') + 1)), false), other_down ? 8.0 : 6.0, 0.05);
        EXPECT_NEAR(read_off(y, std::stod(path.substr(path.find('V') + 1)), false), 14.0, 0.05);
        EXPECT_EQ(std::count(path.begin(), path.end(), 'V'), 1) << "the second point has no error bar";
    }
}

TEST(Svg, an_error_bar_that_reaches_zero_does_not_stretch_a_log_axis) {
    Series data = series({1, 2}, {10, 20}, Mark::points);
    data.y_error = {9.99999, 25.0};
    const auto ticks = ticks_seen(markup::read(svg(figure({data}, false, true))), "y-ticks");
    EXPECT_GE(ticks.front().value, 5.0);
}

TEST(Svg, a_series_can_have_the_colour_and_marker_of_another) {
    Figure f = figure(
        {series({0.0, 1.0}, {2.0, 3.0}), series({0.0, 1.0}, {1.0, 2.0}), series({0.0, 1.0}, {2.0, 3.0}, Mark::points)});
    const auto strokes = [](const Figure& of) {
        std::vector<std::string> out;
        for (const auto& e : markup::read(svg(of))) {
            const auto found = e.attributes.find("class");
            if (found != e.attributes.end() && found->second == "series") out.push_back(e.attributes.at("stroke"));
        }
        return out;
    };
    const auto own = strokes(f);
    EXPECT_NE(own.at(2), own.at(0));
    f.series[2].colour = 0;
    const auto shared = strokes(f);
    EXPECT_EQ(shared.at(2), own.at(0));
    EXPECT_EQ(shared.at(1), own.at(1));
    EXPECT_NE(svg(f).find("<circle"), std::string::npos) << "the marker of the first series is a circle";
}
