#include <zlg/report/figure.hpp>

#include "example_figures.hpp"

using example::infinity;
using example::not_a_number;
using example::series;
using zlg::report::Mark;
using zlg::report::Series;
using zlg::report::thin;

TEST(Thin, keeps_ends_extremes_and_order) {
    Series data = series({}, {});
    for (int i = 0; i < 10000; ++i) {
        data.x.push_back(i);
        data.y.push_back(std::sin(0.01 * i));
        data.y_error.push_back(0.5 * i);
    }
    data.y[4321] = 40.0;
    data.y[8765] = -50.0;
    const Series t = thin(data, 200);
    EXPECT_LE(t.x.size(), 200U);
    EXPECT_GE(t.x.size(), 150U);
    EXPECT_EQ(t.x.front(), 0.0);
    EXPECT_EQ(t.x.back(), 9999.0);
    EXPECT_EQ(*std::max_element(t.y.begin(), t.y.end()), 40.0);
    EXPECT_EQ(*std::min_element(t.y.begin(), t.y.end()), -50.0);
    EXPECT_TRUE(std::is_sorted(t.x.begin(), t.x.end()));
    ASSERT_EQ(t.y_error.size(), t.x.size());
    for (std::size_t i = 0; i < t.x.size(); ++i) EXPECT_EQ(t.y_error[i], 0.5 * t.x[i]);
}

TEST(Thin, a_gap_stays_a_gap) {
    Series data = series({}, {});
    for (int i = 0; i < 3000; ++i) {
        data.x.push_back(i);
        data.y.push_back(i == 1500 ? not_a_number : 0.001 * i);
    }
    const Series t = thin(data, 100);
    EXPECT_LE(t.x.size(), 100U);
    EXPECT_EQ(std::count_if(t.y.begin(), t.y.end(), [](double y) { return std::isnan(y); }), 1);
}

TEST(Thin, leaves_a_short_series_as_it_is_and_bears_small_limits) {
    const Series data = series({1, 2, 3, 4}, {5, 9, 7, 6});
    EXPECT_EQ(thin(data, 4).y, data.y);
    EXPECT_EQ(thin(data, 3).y, (std::vector<double>{5, 6}));
    EXPECT_EQ(thin(data, 2).y, (std::vector<double>{5, 6}));
    EXPECT_EQ(thin(data, 1).y, std::vector<double>{5});
    EXPECT_TRUE(thin(data, 0).y.empty());
    EXPECT_TRUE(thin(data, -1).y.empty());
    EXPECT_EQ(thin(data, 2).name, "measured");
}
