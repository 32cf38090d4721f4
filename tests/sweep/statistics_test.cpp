// Claims about statistics: textbook values, and no failed gyro in a mean.

#include <zlg/sweep/statistics.hpp>

#include "descriptions.hpp"

namespace zlg::sweep::statistics_test {

Description limited() { return parse("[sweep]\ngyros = 9\n" + testing_metric + "max = 2\n", "s"); }

Rows rows_of(const std::vector<double>& values) {
    Rows rows;
    for (std::size_t k = 0; k < values.size(); ++k) {
        const auto gyro = static_cast<std::int64_t>(k);
        rows[gyro] = {.gyro = gyro,
                      .status = std::isfinite(values[k]) ? Status::good : Status::not_finite,
                      .metrics = {values[k]}};
    }
    return rows;
}

// R. G. Newcombe, Stat. Med. 17, 1998, 857, table I: 81 of 263 and 0 of 20 by Wilson's method.
TEST(Statistics, the_interval_of_a_yield_is_wilsons) {
    const Yield common = yield_of(81, 263);
    EXPECT_NEAR(common.low, 0.2553, 5e-5);
    EXPECT_NEAR(common.high, 0.3662, 5e-5);
    const Yield none = yield_of(0, 20);
    EXPECT_EQ(none.low, 0.0);
    EXPECT_NEAR(none.high, 0.1611, 5e-5);
    EXPECT_EQ(yield_of(20, 20).high, 1.0);
    EXPECT_EQ(yield_of(0, 0).gyros, 0);
}

TEST(Statistics, quantiles_lie_on_straight_lines) {
    const std::vector<double> v{1.0, 2.0, 4.0, 8.0};
    EXPECT_EQ(quantile(v, 0.0), 1.0);
    EXPECT_EQ(quantile(v, 0.5), 3.0);
    EXPECT_EQ(quantile(v, 1.0), 8.0);
    EXPECT_EQ(quantile(std::vector{5.0}, 0.95), 5.0);
}

TEST(Statistics, a_failed_gyro_is_counted_and_in_no_mean) {
    const Summary s = summary_of(limited(), rows_of({1.0, 2.0, std::nan(""), 3.0}));
    EXPECT_EQ(s.gyros, 4);
    EXPECT_EQ(s.failed, 1);
    EXPECT_EQ(s.metrics[0].mean, 2.0);
    EXPECT_EQ(s.metrics[0].sd, 1.0);
    EXPECT_EQ(s.metrics[0].p50, 2.0);
    EXPECT_EQ(s.metrics[0].yield->value, 0.5) << "a gyro that fails does not pass";
    EXPECT_EQ(s.yield->passed, 2);
}

TEST(Statistics, of_no_good_gyro_nothing_is_said) {
    const Summary s = summary_of(limited(), rows_of({std::nan("")}));
    EXPECT_FALSE(s.metrics[0].mean || s.metrics[0].sd || s.metrics[0].p05);
    EXPECT_EQ(s.metrics[0].yield->value, 0.0);
    EXPECT_FALSE(summary_of(limited(), {}).yield);
    EXPECT_FALSE(summary_of(limited(), rows_of({1.0})).metrics[0].sd) << "one has no spread";
}

TEST(Statistics, limits_belong_to_what_passes) {
    const Metric both{.name = "x", .min = 1.0, .max = 2.0};
    EXPECT_TRUE(passes(both, 1.0) && passes(both, 2.0));
    EXPECT_FALSE(passes(both, 0.999) || passes(both, 2.001) || passes(both, std::nan("")));
}

TEST(Statistics, the_worst_are_the_failed_ones_and_then_the_farthest) {
    const Rows rows = rows_of({1.0, 5.0, std::nan(""), 1.1, 0.2});
    std::vector<std::int64_t> gyros;
    for (const Row* row : worst(limited(), rows, 3)) gyros.push_back(row->gyro);
    EXPECT_EQ(gyros, (std::vector<std::int64_t>{2, 1, 4}));
    EXPECT_EQ(worst(limited(), rows, 99).size(), 5u);
}

}  // namespace zlg::sweep::statistics_test
