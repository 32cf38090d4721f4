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

Yield independent(std::int64_t passed, std::int64_t gyros) {
    YieldCount count{Description{}};
    for (std::int64_t gyro = 0; gyro < gyros; ++gyro) count.add(gyro);
    for (std::int64_t gyro = 0; gyro < passed; ++gyro) count.pass(gyro);
    return count.yield();
}

// R. G. Newcombe, Stat. Med. 17, 1998, 857, table I: 81 of 263 and 0 of 20 by Wilson's method.
TEST(Statistics, the_interval_of_a_yield_is_wilsons) {
    const Yield common = independent(81, 263);
    EXPECT_NEAR(common.low, 0.2553, 5e-5);
    EXPECT_NEAR(common.high, 0.3662, 5e-5);
    const Yield none = independent(0, 20);
    EXPECT_EQ(none.low, 0.0);
    EXPECT_NEAR(none.high, 0.1611, 5e-5);
    EXPECT_EQ(independent(20, 20).high, 1.0);
}

// A design of d parameters, of which a gyro passes where its response is below the limit.
Description design_of(std::size_t d) {
    Description description;
    description.parameters.resize(d);
    description.sensitivity = true;
    return description;
}

// The largest of the parameters, their sum, or one of them.
enum class Response { largest, sum, first };

double value_of(Response response, const std::vector<double>& x) {
    if (response == Response::first) return x.front();
    return response == Response::largest ? *std::ranges::max_element(x) : std::accumulate(x.begin(), x.end(), 0.0);
}

std::vector<double> uniform_numbers(std::size_t n, std::mt19937_64& random) {
    std::vector<double> x(n);
    std::ranges::generate(x, [&] { return std::uniform_real_distribution<double>{}(random); });
    return x;
}

// Of Saltelli's design: A, A with one number from B, B.
std::vector<double> gyro_of_row(const std::vector<double>& a, const std::vector<double>& b, std::size_t kind) {
    std::vector<double> x = kind == a.size() + 1 ? b : a;
    if (kind > 0 && kind <= a.size()) x[kind - 1] = b[kind - 1];
    return x;
}

struct Coverage {
    double of_rows = 0.0;
    double as_if_independent = 0.0;
};

// How often the interval holds the true yield of designs whose rows are drawn at random. A gyro passes below a limit of
// its response.
Coverage coverage(std::size_t d, int n_rows, Response response, double yield) {
    constexpr int trials = 400;
    const Description description = design_of(d);
    std::mt19937_64 random{3};
    std::vector<double> many(100'000);
    std::ranges::generate(many, [&] { return value_of(response, uniform_numbers(d, random)); });
    std::ranges::sort(many);
    const double limit = quantile(many, yield);
    const auto holds = [&](const Yield& y) { return y.low <= yield && yield <= y.high ? 1.0 / trials : 0.0; };
    Coverage coverage;
    for (int trial = 0; trial < trials; ++trial) {
        YieldCount count{description};
        std::int64_t gyro = 0;
        for (int row = 0; row < n_rows; ++row) {
            const std::vector<double> a = uniform_numbers(d, random), b = uniform_numbers(d, random);
            for (std::size_t kind = 0; kind < d + 2; ++kind, ++gyro) {
                count.add(gyro);
                if (value_of(response, gyro_of_row(a, b, kind)) < limit) count.pass(gyro);
            }
        }
        const Yield found = count.yield();
        coverage.of_rows += holds(found);
        coverage.as_if_independent += holds(independent(found.passed, found.gyros));
    }
    return coverage;
}

// 0.95 has a standard error of 0.011.
TEST(Statistics, the_interval_of_a_design_of_rows_holds_the_yield) {
    for (const Response response : {Response::largest, Response::sum, Response::first})
        for (const double yield : {0.9, 0.97})
            for (const auto& [d, n_rows] : {std::pair{std::size_t{3}, 100}, {8, 32}, {25, 40}}) {
                const Coverage found = coverage(d, n_rows, response, yield);
                EXPECT_GE(found.of_rows, 0.93) << static_cast<int>(response) << ' ' << yield << ' ' << d;
                EXPECT_LE(found.as_if_independent, 0.93) << static_cast<int>(response) << ' ' << yield << ' ' << d;
            }
}

// `passed` of the first `n` gyros of each row.
Yield yield_of_rows(const std::vector<std::pair<int, int>>& rows, std::size_t d) {
    YieldCount count{design_of(d)};
    for (std::size_t row = 0; row < rows.size(); ++row)
        for (int k = 0; k < rows[row].first; ++k) {
            const auto gyro = static_cast<std::int64_t>(row * (d + 2)) + k;
            count.add(gyro);
            if (k < rows[row].second) count.pass(gyro);
        }
    return count.yield();
}

TEST(Statistics, rows_are_worth_what_their_gyros_differ) {
    EXPECT_EQ(YieldCount{Description{}}.yield().gyros, 0);
    // Without sensitivity, and with one gyro of each row, gyros are independent.
    EXPECT_EQ(independent(1, 40).worth, 40.0);
    EXPECT_DOUBLE_EQ(yield_of_rows({{1, 1}, {1, 0}, {1, 1}, {1, 1}}, 2).worth, 4.0);
    // Whatever all the gyros of a row do, it is one; unequal rows are fewer than they are: 13^2/(10^2 + 3) of one row
    // of 10 and three of 1.
    EXPECT_DOUBLE_EQ(yield_of_rows({{4, 4}, {4, 4}, {4, 4}}, 2).worth, 3.0);
    EXPECT_DOUBLE_EQ(yield_of_rows({{4, 4}}, 2).worth, 1.0);
    EXPECT_NEAR(yield_of_rows({{4, 4}, {4, 0}, {4, 4}, {4, 4}}, 2).worth, 4.0, 1e-12);
    EXPECT_DOUBLE_EQ(yield_of_rows({{10, 10}, {1, 1}, {1, 1}, {1, 1}}, 8).worth, 169.0 / 103.0);
    // Gyros of which half pass in every row say more than as many rows: with k rows of which each has both, var p = 8
    // v1/(k + 8).
    EXPECT_NEAR(yield_of_rows(std::vector<std::pair<int, int>>(8, {4, 2}), 2).worth, 16.0, 1e-12);
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
