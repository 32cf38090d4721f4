// Claims about tolerances: of a known rule for what passes, the parameter that decides is drawn in, and no other.

#include <zlg/sweep/tolerances.hpp>

#include "descriptions.hpp"

namespace zlg::sweep::tolerances_test {

const std::string two =
    "[sweep]\ngyros = 2000\n"
    "[[parameter]]\nkeys = [\"piezo.half_wave_error\"]\ndraw = \"uniform\"\nmin = -0.2\nmax = 0.2\n"
    "[[parameter]]\nkeys = [\"gyro.bias_chi\"]\ndraw = \"uniform\"\nmin = 3.5\nmax = 3.8\n" +
    testing_metric + "max = 1\n";

// Passes where |half_wave_error| < 0.1.
Rows rows_of(const Gyros& gyros) {
    Rows rows;
    for (std::int64_t k = 0; k < gyros.description().n_gyros; ++k)
        rows[k] = {.gyro = k, .metrics = {std::abs(std::get<double>(gyros.values(k)[0])) < 0.1 ? 0.5 : 2.0}};
    return rows;
}

TEST(Tolerances, ways_run_from_the_base_to_the_ends) {
    const Placement placement{Gyros{parse(two, "s")}, {}};
    const std::vector<Range>& found = placement.ranges();
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[0].nominal, 0.0);
    EXPECT_EQ(found[1].nominal, 3.6) << "of the base";
    // A difference of numbers near 3.6 carries their rounding.
    EXPECT_NEAR(found[1].way(3.7), 0.5, 1e-14);
    EXPECT_NEAR(found[1].way(3.55), 0.5, 1e-14);
    EXPECT_DOUBLE_EQ(found[1].below(0.5), 3.55);
    EXPECT_DOUBLE_EQ(found[1].above(0.5), 3.7);
}

TEST(Tolerances, the_yield_within_half_the_way_is_one_by_the_rule) {
    const Gyros gyros{parse(two, "s")};
    const Placement placement{gyros, rows_of(gyros)};
    const auto whole = placement.yield_within({1.0, 1.0});
    EXPECT_EQ(whole->gyros, 2000);
    EXPECT_NEAR(whole->value, 0.5, 0.05);
    EXPECT_EQ(placement.yield_within({0.5, 1.0})->value, 1.0);
    EXPECT_FALSE(placement.yield_within({0.0, 0.0}));
}

TEST(Tolerances, only_the_parameter_that_decides_is_drawn_in) {
    const Gyros gyros{parse(two, "s")};
    const Tolerances found = tolerances(Placement{gyros, rows_of(gyros)}, 0.95);
    EXPECT_TRUE(found.is_reached);
    EXPECT_GE(found.yield->value, 0.95);
    // 95 % pass within 0.1/0.95; a step of a tenth may go that much too far.
    EXPECT_LE(found.ways[0], 0.5 / 0.95 * 1.03);
    EXPECT_GE(found.ways[0], 0.9 * 0.5 / 0.95 * 0.97);
    EXPECT_EQ(found.ways[1], 1.0);
}

// What lies far out in the tails of a normal law is where gyros fail.
TEST(Tolerances, the_full_range_of_a_normal_law_has_all_gyros) {
    const Gyros gyros{
        parse("[sweep]\ngyros = 2000\n[[parameter]]\nkeys = [\"piezo.half_wave_error\"]\n"
              "draw = \"normal\"\nmean = 0\nsd = 0.05\n" +
                  testing_metric + "max = 1\n",
              "s")};
    const Placement placement{gyros, rows_of(gyros)};
    const std::vector<Range>& found = placement.ranges();
    const auto whole = placement.yield_within({1.0});
    EXPECT_EQ(whole->gyros, 2000);
    // Passes within two standard deviations.
    EXPECT_NEAR(whole->value, std::erf(std::sqrt(2.0)), 0.015);
    EXPECT_LT(found[0].min, -0.1);
    EXPECT_GT(found[0].max, 0.1);
}

TEST(Tolerances, too_few_gyros_reach_nothing) {
    const Gyros gyros{parse(two, "s")};
    Rows rows = rows_of(gyros);
    for (auto& [gyro, row] : rows) row.metrics[0] = 2.0;
    const Tolerances found = tolerances(Placement{gyros, rows}, 0.95);
    EXPECT_FALSE(found.is_reached);
    EXPECT_GE(found.yield->gyros, 30);
}

}  // namespace zlg::sweep::tolerances_test
