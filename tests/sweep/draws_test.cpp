// Claims about draws: each is of the law that it is asked for, and depends on nothing but seed, keys and gyro.

#include <zlg/sweep/draws.hpp>

#include "descriptions.hpp"

namespace zlg::sweep::draws_test {

Description sweep_of(std::int64_t n_gyros, std::vector<Parameter> parameters, std::uint64_t seed = 1) {
    Description d;
    d.n_gyros = n_gyros;
    d.seed = seed;
    d.parameters = std::move(parameters);
    return d;
}

Parameter between(DrawKind draw, double min, double max, std::string key = "gyro.bias_chi") {
    return {.keys = {std::move(key)}, .draw = draw, .min = min, .max = max};
}

std::vector<double> column(const Description& d, std::size_t parameter) {
    const Draws draws{d};
    std::vector<double> values;
    for (std::int64_t k = 0; k < d.n_gyros; ++k) values.push_back(std::get<double>(draws.values(k)[parameter]));
    return values;
}

double mean(const std::vector<double>& v) {
    return std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size());
}

double sd(const std::vector<double>& v) {
    double sum = 0.0;
    for (const double x : v) sum += (x - mean(v)) * (x - mean(v));
    return std::sqrt(sum / static_cast<double>(v.size() - 1));
}

TEST(Draws, seeds_are_positive_differ_and_follow_the_seed_of_the_sweep) {
    const Description d = sweep_of(1000, {});
    std::set<std::int64_t> seeds;
    for (std::int64_t k = 0; k < d.n_gyros; ++k) seeds.insert(gyro_seed(d, k));
    EXPECT_EQ(seeds.size(), 1000u);
    EXPECT_GT(*seeds.begin(), 0);
    EXPECT_NE(gyro_seed(d, 0), gyro_seed(sweep_of(1000, {}, 2), 0));
    EXPECT_EQ(gyro_seed(d, 7), gyro_seed(sweep_of(9, {between(DrawKind::uniform, 1, 2)}), 7))
        << "whatever its parameters";
}

TEST(Draws, a_parameter_more_changes_no_other) {
    const Parameter first = between(DrawKind::uniform, 0.0, 1.0);
    const Parameter second = between(DrawKind::uniform, 0.0, 1.0, "piezo.half_wave_v");
    const std::vector<double> alone = column(sweep_of(50, {second}), 0);
    EXPECT_EQ(alone, column(sweep_of(50, {first, second}), 1));
    EXPECT_NE(alone, column(sweep_of(50, {first, second}), 0));
}

TEST(Draws, more_gyros_leave_the_first_ones) {
    for (const DrawKind kind : {DrawKind::uniform, DrawKind::log_uniform, DrawKind::sobol}) {
        std::vector<double> many = column(sweep_of(64, {between(kind, 1.0, 2.0)}), 0);
        many.resize(20);
        EXPECT_EQ(many, column(sweep_of(20, {between(kind, 1.0, 2.0)}), 0));
    }
}

TEST(Draws, uniform_and_normal_have_their_moments) {
    constexpr int n = 10'000;
    const std::vector<double> even = column(sweep_of(n, {between(DrawKind::uniform, 2.0, 5.0)}), 0);
    EXPECT_NEAR(mean(even), 3.5, 4.0 * 3.0 / std::sqrt(12.0 * n));
    EXPECT_NEAR(sd(even), 3.0 / std::sqrt(12.0), 0.02);
    const Parameter normal{.keys = {"gyro.bias_chi"}, .draw = DrawKind::normal, .mean = -1.0, .sd = 0.5};
    const std::vector<double> bell = column(sweep_of(n, {normal}), 0);
    EXPECT_NEAR(mean(bell), -1.0, 4.0 * 0.5 / std::sqrt(n));
    EXPECT_NEAR(sd(bell), 0.5, 4.0 * 0.5 / std::sqrt(2.0 * n));
}

TEST(Draws, log_uniform_is_even_in_the_logarithm) {
    std::vector<double> values = column(sweep_of(10'000, {between(DrawKind::log_uniform, 1e-3, 1e3)}), 0);
    for (double& value : values) {
        EXPECT_TRUE(value >= 1e-3 && value < 1e3 * (1 + 1e-12));
        value = std::log10(value);
    }
    EXPECT_NEAR(mean(values), 0.0, 0.07);
    EXPECT_NEAR(sd(values), 6.0 / std::sqrt(12.0), 0.03);
}

TEST(Draws, truncated_keeps_its_bounds_and_the_shape_between_them) {
    const Parameter p{
        .keys = {"gyro.bias_chi"}, .draw = DrawKind::truncated, .min = 0.0, .max = 3.0, .mean = 0.0, .sd = 1.0};
    const std::vector<double> values = column(sweep_of(10'000, {p}), 0);
    EXPECT_TRUE(std::ranges::all_of(values, [](double x) { return x >= 0.0 && x <= 3.0; }));
    // Mean of the half normal law, cut at 3: sqrt(2/pi)(1 - exp(-9/2))/erf(3/sqrt(2)).
    EXPECT_NEAR(mean(values), std::sqrt(2.0 / M_PI) * (1.0 - std::exp(-4.5)) / std::erf(3.0 / std::sqrt(2.0)), 0.024);
}

TEST(Draws, each_part_of_a_latin_hypercube_has_one_gyro) {
    constexpr int n = 97;
    const Description d =
        sweep_of(n, {between(DrawKind::latin, 10.0, 20.0), between(DrawKind::latin, 0.0, 1.0, "piezo.half_wave_v")});
    for (const std::size_t parameter : {0u, 1u}) {
        std::vector<double> values = column(d, parameter);
        EXPECT_FALSE(std::ranges::is_sorted(values));
        std::ranges::sort(values);
        const Parameter& p = d.parameters[parameter];
        for (int k = 0; k < n; ++k) {
            const double place = (values[static_cast<std::size_t>(k)] - p.min) / (p.max - p.min) * n;
            EXPECT_TRUE(place >= k && place < k + 1) << place;
        }
    }
}

TEST(Draws, sobol_without_shift_is_the_published_sequence) {
    Description d =
        sweep_of(8, {between(DrawKind::sobol, 0.0, 1.0), between(DrawKind::sobol, 0.0, 1.0, "piezo.half_wave_v"),
                     between(DrawKind::sobol, 0.0, 1.0, "gyro.tick_s")});
    d.sobol_shift = false;
    // First points of new-joe-kuo-6 in the order of Gray's code, from its direction numbers by hand: v = 1/2, 1/4, 1/8
    // in the first dimension, 1/2, 3/4, 5/8 in the second, 1/2, 3/4, 1/8 in the third.
    EXPECT_EQ(column(d, 0), (std::vector<double>{0, 0.5, 0.75, 0.25, 0.375, 0.875, 0.625, 0.125}));
    EXPECT_EQ(column(d, 1), (std::vector<double>{0, 0.5, 0.25, 0.75, 0.375, 0.875, 0.125, 0.625}));
    EXPECT_EQ(column(d, 2), (std::vector<double>{0, 0.5, 0.25, 0.75, 0.625, 0.125, 0.875, 0.375}));
}

// Of 2^8 points of the first two dimensions each rectangle of 2^-a by 2^-b, a + b = 8, holds exactly one: a (0, 8,
// 2)-net, which a digital shift leaves one.
TEST(Draws, sobol_with_shift_is_still_a_net) {
    for (const std::uint64_t seed : {1u, 2u}) {
        const Description d = sweep_of(
            256, {between(DrawKind::sobol, 0.0, 1.0), between(DrawKind::sobol, 0.0, 1.0, "piezo.half_wave_v")}, seed);
        const std::vector<double> x = column(d, 0);
        const std::vector<double> y = column(d, 1);
        EXPECT_NE(x[0], 0.0);
        for (int a = 0; a <= 8; ++a) {
            std::set<std::pair<int, int>> boxes;
            for (std::size_t k = 0; k < x.size(); ++k)
                boxes.emplace(static_cast<int>(std::ldexp(x[k], a)), static_cast<int>(std::ldexp(y[k], 8 - a)));
            EXPECT_EQ(boxes.size(), 256u);
        }
    }
}

TEST(Draws, of_a_grid_the_last_parameter_runs_fastest) {
    const Parameter a{.keys = {"gyro.bias_chi"}, .draw = DrawKind::grid, .values = {1.0, 2.0}};
    const Parameter b{
        .keys = {"compensation.bridge"}, .draw = DrawKind::grid, .values = {"\"none\"", "\"auto\"", "\"linear\""}};
    const Draws draws{sweep_of(12, {a, b})};
    EXPECT_EQ(draws.values(0), (std::vector<Value>{1.0, "\"none\""}));
    EXPECT_EQ(draws.values(2), (std::vector<Value>{1.0, "\"linear\""}));
    EXPECT_EQ(draws.values(3), (std::vector<Value>{2.0, "\"none\""}));
    EXPECT_EQ(draws.values(6), draws.values(0)) << "each point again";
}

TEST(Draws, a_list_is_taken_in_turn) {
    const Parameter p{.keys = {"gyro.bias_chi"}, .draw = DrawKind::list, .values = {3.0, 1.0}};
    EXPECT_EQ(column(sweep_of(5, {p}), 0), (std::vector<double>{3.0, 1.0, 3.0, 1.0, 3.0}));
}

}  // namespace zlg::sweep::draws_test
