// Claims about statistics: textbook values, and no failed gyro in a mean.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include <zlg/sweep/statistics.hpp>

#include "descriptions.hpp"

namespace {

using namespace zlg::sweep;

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
}

// A design of d parameters, of which a gyro passes where its response is below the limit.
Description design_of(std::size_t d) {
    Description description;
    description.parameters.resize(d);
    description.sensitivity = true;
    return description;
}

// How often the interval holds the true yield, 0.9, of rows that are drawn at random. A gyro passes where the largest of its parameters is
// below the tenth root, or where their sum is below its quantile.
double coverage(std::size_t d, int n_rows, bool is_largest) {
    constexpr int trials = 600;
    const Description description = design_of(d);
    std::mt19937_64 random{3};
    std::uniform_real_distribution<double> uniform;
    const auto response = [&](const std::vector<double>& x) {
        return is_largest ? *std::ranges::max_element(x) : std::accumulate(x.begin(), x.end(), 0.0);
    };
    const auto drawn = [&] {
        std::vector<double> x(d);
        std::ranges::generate(x, [&] { return uniform(random); });
        return x;
    };
    double limit = std::pow(0.9, 1.0 / static_cast<double>(d));
    if (!is_largest) {
        std::vector<double> many(40'000);
        std::ranges::generate(many, [&] { return response(drawn()); });
        std::ranges::sort(many);
        limit = many[36'000];
    }
    int held = 0;
    for (int trial = 0; trial < trials; ++trial) {
        YieldCount count{description};
        std::int64_t gyro = 0;
        for (int row = 0; row < n_rows; ++row) {
            const std::vector<double> a = drawn(), b = drawn();
            for (std::size_t kind = 0; kind < d + 2; ++kind, ++gyro) {
                std::vector<double> x = kind == d + 1 ? b : a;
                if (kind > 0 && kind <= d) x[kind - 1] = b[kind - 1];
                count.add(gyro);
                if (response(x) < limit) count.pass(gyro);
            }
        }
        const Yield y = count.yield();
        if (y.low <= 0.9 && 0.9 <= y.high) ++held;
    }
    return static_cast<double>(held) / trials;
}

// 0.95 has a standard error of 0.009. Rows taken for independent gyros gave 0.57 to 0.83.
TEST(Statistics, the_interval_of_a_design_of_rows_holds_the_yield) {
    for (const bool is_largest : {false, true}) {
        EXPECT_GE(coverage(8, 32, is_largest), 0.93) << is_largest;
        EXPECT_GE(coverage(3, 100, is_largest), 0.93) << is_largest;
        EXPECT_GE(coverage(15, 20, is_largest), 0.89) << is_largest << ": few rows for so many parameters";
    }
}

TEST(Statistics, a_count_is_the_yield_of_independent_gyros_and_never_surer_than_its_rows) {
    YieldCount alone{Description{}};
    YieldCount rows{design_of(2)};
    for (std::int64_t gyro = 0; gyro < 40; ++gyro) {
        for (YieldCount* count : {&alone, &rows}) count->add(gyro);
        for (YieldCount* count : {&alone, &rows}) count->pass(gyro);
    }
    EXPECT_EQ(alone.yield().low, yield_of(40, 40).low);
    EXPECT_LT(rows.yield().low, yield_of(10, 10).low) << "ten rows, and Student's t";
    EXPECT_EQ(rows.yield().passed, 40);
    EXPECT_EQ(YieldCount{Description{}}.yield().gyros, 0);
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

}  // namespace
