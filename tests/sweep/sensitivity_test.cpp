// Claims about sensitivity: exact indices of known functions lie within the intervals, and a failed run breaks no
// estimate.

#include <zlg/chance/draw.hpp>
#include <zlg/sweep/draws.hpp>
#include <zlg/sweep/sensitivity.hpp>

#include "descriptions.hpp"

namespace zlg::sweep::sensitivity_test {

constexpr double pi = std::numbers::pi;
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

// T. Ishigami, T. Homma, 1990, with a = 7, b = 0.1.
double ishigami(const std::vector<double>& x) {
    return std::sin(x[0]) + 7.0 * std::pow(std::sin(x[1]), 2) + 0.1 * std::pow(x[2], 4) * std::sin(x[0]);
}

// V1 = (1 + b pi^4/5)^2/2, V2 = a^2/8, V13 = b^2 pi^8 (1/18 - 1/50).
struct Exact {
    double v1 = 0.5 * std::pow(1.0 + 0.1 * std::pow(pi, 4) / 5.0, 2);
    double v2 = 49.0 / 8.0;
    double v13 = 0.01 * std::pow(pi, 8) * (1.0 / 18.0 - 1.0 / 50.0);
    double v = v1 + v2 + v13;
    std::array<double, 3> first{v1 / v, v2 / v, 0.0};
    std::array<double, 3> total{(v1 + v13) / v, v2 / v, v13 / v};
};

struct Sample {
    std::vector<double> points;
    std::vector<double> values;
};

// The gyros of a sweep with sensitivity, in three parameters over [-pi, pi].
Sample sample(std::int64_t rows, std::uint64_t seed) {
    Description d;
    d.sensitivity = true;
    d.n_gyros = 5 * rows;
    d.seed = seed;
    for (const char* key : {"a.x", "a.y", "a.z"})
        d.parameters.push_back({.keys = {key}, .draw = DrawKind::sobol, .min = -pi, .max = pi});
    const Draws draws{d};
    Sample s;
    for (std::int64_t k = 0; k < d.n_gyros; ++k) {
        std::vector<double> x;
        for (const Value& value : draws.values(k)) x.push_back(std::get<double>(value));
        s.points.insert(s.points.end(), x.begin(), x.end());
        s.values.push_back(ishigami(x));
    }
    return s;
}

TEST(Sensitivity, indices_of_ishigamis_function_lie_within_their_intervals) {
    const Sample s = sample(4096, 3);
    const SobolIndices found = sobol_indices(as_design(s.points, s.values, 3));
    const Exact exact;
    EXPECT_EQ(found.n_rows, 4096u);
    EXPECT_NEAR(found.variance, exact.v, 0.1);
    for (std::size_t i = 0; i < 3; ++i) {
        const SobolIndex& index = found.inputs[i];
        EXPECT_TRUE(index.first_low <= exact.first[i] && exact.first[i] <= index.first_high) << i;
        EXPECT_TRUE(index.total_low <= exact.total[i] && exact.total[i] <= index.total_high) << i;
        EXPECT_NEAR(index.first, exact.first[i], 0.01);
        EXPECT_NEAR(index.total, exact.total[i], 0.01);
    }
}

// By hand: f(A) = 1, 2, 4; f(B) = 2, 0, 1; f(A_B) = 1, 3, 2. V = 7/3, c = 5.
TEST(Sensitivity, estimators_are_those_of_jansen) {
    const SobolDesign design{.a = {1, 2, 4}, .b = {2, 0, 1}, .mixed = {{1, 3, 2}}};
    const SobolIndices found = sobol_indices(design);
    EXPECT_NEAR(found.variance, 7.0 / 3.0, 1e-15);
    EXPECT_NEAR(found.inputs[0].first, 1.0 - 11.0 / (5.0 * 7.0 / 3.0), 1e-15);
    EXPECT_NEAR(found.inputs[0].total, 5.0 / (5.0 * 7.0 / 3.0), 1e-15);
}

TEST(Sensitivity, a_failed_run_takes_its_whole_row_along_and_nothing_else) {
    Sample s = sample(256, 1);
    SobolDesign design = as_design(s.points, s.values, 3);
    SobolDesign shorter = design;
    design.mixed[1][17] = not_a_number;
    design.a[100] = not_a_number;
    for (auto* column : {&shorter.a, &shorter.b, &shorter.mixed[0], &shorter.mixed[1], &shorter.mixed[2]})
        for (const int row : {100, 17}) column->erase(column->begin() + row);
    const SobolIndices found = sobol_indices(design);
    const SobolIndices expected = sobol_indices(shorter);
    EXPECT_EQ(found.n_rows, 254u);
    EXPECT_EQ(found.n_dropped, 2u);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(found.inputs[i].first, expected.inputs[i].first, 1e-12);
        EXPECT_NEAR(found.inputs[i].total, expected.inputs[i].total, 1e-12);
    }
}

TEST(Sensitivity, both_orders_of_points_are_known) {
    const Sample by_rows = sample(64, 2);
    Sample by_blocks;
    for (const std::size_t kind : {0u, 4u, 1u, 2u, 3u})
        for (std::size_t row = 0; row < 64; ++row) {
            const std::size_t at = 5 * row + kind;
            by_blocks.values.push_back(by_rows.values[at]);
            for (std::size_t k = 0; k < 3; ++k) by_blocks.points.push_back(by_rows.points[3 * at + k]);
        }
    const SobolIndices a = sobol_indices(as_design(by_rows.points, by_rows.values, 3));
    const SobolIndices b = sobol_indices(as_design(by_blocks.points, by_blocks.values, 3));
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(a.inputs[i].first, b.inputs[i].first);
    by_blocks.points[7] += 0.5;
    EXPECT_THROW((void)as_design(by_blocks.points, by_blocks.values, 3), std::invalid_argument);
    EXPECT_THROW((void)as_design(by_rows.points, std::vector<double>(7), 3), std::invalid_argument);
}

TEST(Sensitivity, of_no_variance_nothing_is_known) {
    const SobolDesign flat{.a = {1, 1, 1}, .b = {1, 1, 1}, .mixed = {{1, 1, 1}}};
    EXPECT_TRUE(std::isnan(sobol_indices(flat).inputs[0].first));
    EXPECT_TRUE(std::isnan(sobol_indices({.a = {1}, .b = {2}, .mixed = {{3}}}).inputs[0].total));
    EXPECT_THROW((void)sobol_indices({.a = {1, 2}, .b = {1}, .mixed = {{1, 2}}}), std::invalid_argument);
}

TEST(Sensitivity, ranks_correlate_by_order_alone) {
    const std::vector<double> x{1, 2, 3, 4, 5};
    EXPECT_DOUBLE_EQ(rank_correlation(x, std::vector<double>{1, 8, 27, 64, 125}).value(), 1.0);
    EXPECT_DOUBLE_EQ(rank_correlation(x, std::vector<double>{5, 4, 3, 2, 1}).value(), -1.0);
    // Ranks 1, 2.5, 2.5, 4, 5 against 1..5: 9.5/sqrt(10 * 9.5).
    EXPECT_NEAR(rank_correlation(x, std::vector<double>{0, 3, 3, 7, 9}).value(), std::sqrt(0.95), 1e-15);
    EXPECT_FALSE(rank_correlation(x, std::vector<double>{2, 2, 2, 2, 2}));
    EXPECT_FALSE(rank_correlation(std::vector<double>{1, 2}, std::vector<double>{1, 2}));
    EXPECT_NEAR(chance_correlation(101), 0.196, 1e-12);
}

// How often the correlation with a parameter that decides nothing is beyond what chance gives, in designs whose rows
// are drawn at random. The others decide the number by their sum, or the largest of them does.
double false_alarms(std::size_t d, std::size_t n_rows, bool is_sum, std::size_t n_independent) {
    constexpr int trials = 1000;
    std::mt19937_64 random{5};
    std::uniform_real_distribution<double> uniform;
    const double limit = chance_correlation(n_independent);
    int alarms = 0;
    for (int trial = 0; trial < trials; ++trial) {
        std::vector<double> idle, decided;
        for (std::size_t row = 0; row < n_rows; ++row) {
            std::vector<double> a(d), b(d);
            for (auto* x : {&a, &b}) std::ranges::generate(*x, [&] { return uniform(random); });
            for (std::size_t kind = 0; kind < d + 2; ++kind) {
                std::vector<double> x = kind == d + 1 ? b : a;
                if (kind > 0 && kind <= d) x[kind - 1] = b[kind - 1];
                idle.push_back(x[0]);
                decided.push_back(is_sum ? std::accumulate(x.begin() + 1, x.end(), 0.0)
                                         : *std::max_element(x.begin() + 1, x.end()));
            }
        }
        if (std::abs(rank_correlation(idle, decided).value()) > limit) ++alarms;
    }
    return static_cast<double>(alarms) / trials;
}

// 5 % with a standard error of 0.7 %.
TEST(Sensitivity, a_design_passes_chance_as_often_as_independent_gyros_do) {
    for (const std::size_t d : {2u, 5u, 15u})
        for (const bool is_sum : {true, false})
            EXPECT_NEAR(false_alarms(d, 64, is_sum, independent_gyros(64, d)), 0.05, 0.02) << d << is_sum;
    EXPECT_GT(false_alarms(15, 64, true, 64 * 17), 0.2) << "were all gyros independent";
    EXPECT_EQ(independent_gyros(10, 2), 40u);
}

TEST(Sensitivity, a_design_needs_sobol_everywhere_and_whole_rows) {
    const std::string parameter = "[[parameter]]\nkeys = [\"gyro.bias_chi\"]\nmin = 3\nmax = 4\ndraw = ";
    const auto of = [&](const std::string& n, const std::string& draw) {
        return parse("[sweep]\nsensitivity = true\ngyros = " + n + "\n" + parameter + draw + "\n" + testing_metric,
                     "s");
    };
    EXPECT_EQ(of("9", "\"sobol\"").n_gyros, 9);
    EXPECT_THROW((void)of("10", "\"sobol\""), zlg::config::ConfigError);
    EXPECT_THROW((void)of("9", "\"uniform\""), zlg::config::ConfigError);
}

// Independent points, for which the resampling of rows is made.
SobolDesign independent_rows(int n, std::uint64_t seed) {
    zlg::chance::Draw draw{seed, zlg::chance::Cause::test};
    SobolDesign design{.a = {}, .b = {}, .mixed = {{}, {}, {}}};
    for (int row = 0; row < n; ++row) {
        std::vector<double> a(3), b(3);
        for (double& x : a) x = draw.within(-pi, pi);
        for (double& x : b) x = draw.within(-pi, pi);
        design.a.push_back(ishigami(a));
        design.b.push_back(ishigami(b));
        for (std::size_t i = 0; i < 3; ++i) {
            std::vector<double> mixed = a;
            mixed[i] = b[i];
            design.mixed[i].push_back(ishigami(mixed));
        }
    }
    return design;
}

// The interval of 95 % holds the exact index in 90 to 97 % of the trials; in 2000 of them it does so in 93 to 95 %, as
// percentiles of 500 rows with long tails do.
TEST(Sensitivity, bootstrap_intervals_cover_as_often_as_they_say) {
    const Exact exact;
    std::array<int, 6> covered{};
    constexpr int trials = 200;
    for (int trial = 0; trial < trials; ++trial) {
        const auto seed = static_cast<std::uint64_t>(trial);
        const SobolIndices found = sobol_indices(independent_rows(500, seed), 300, seed);
        for (std::size_t i = 0; i < 3; ++i) {
            const SobolIndex& index = found.inputs[i];
            covered[i] += index.first_low <= exact.first[i] && exact.first[i] <= index.first_high;
            covered[i + 3] += index.total_low <= exact.total[i] && exact.total[i] <= index.total_high;
        }
    }
    for (const int n : covered) {
        EXPECT_GE(n, 180) << "90 %";
        EXPECT_LE(n, 194) << "97 %";
    }
}

}  // namespace zlg::sweep::sensitivity_test
