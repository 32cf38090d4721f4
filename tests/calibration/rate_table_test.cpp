
#include <zlg/calibration/rate_table.hpp>
#include <zlg/deviations/series.hpp>

#include "test.hpp"

namespace zlg::calibration::rate_table_test {

struct Table {
    std::vector<double> input, output;

    // Counts a second of a gyro of 0.5 counts an arcsec and a bias of 4 arcsec/s.
    void turn(double rate, int n, double slope = 0.5, double noise = 0.0) {
        for (int k = 0; k < n; ++k) {
            input.push_back(rate);
            output.push_back(slope * rate + 2.0 + noise * normal_(engine_));
        }
    }

private:
    std::mt19937 engine_{1};
    std::normal_distribution<double> normal_;
};

TEST(RateTable, a_straight_line_is_found_exactly) {
    Table t;
    for (const double rate : {-3000.0, -1000.0, 0.0, 1000.0, 3000.0}) t.turn(rate, 100, 0.5, 1e-9);
    const RateTable r = rate_table(t.input, t.output);
    ASSERT_EQ(r.stages.size(), 5u);
    EXPECT_EQ(r.stages[1].n_samples, 100);
    EXPECT_NEAR(r.scale_factor.value, 0.5, 1e-12);
    EXPECT_NEAR(r.arcsec_per_unit.value, 2.0, 1e-12);
    EXPECT_NEAR(r.bias_arcsec_s.value, 4.0, 1e-9);
    EXPECT_NEAR(r.largest_residual_ppm, 0.0, 1e-6);
    EXPECT_NEAR(r.asymmetry_ppm.value, 0.0, 1e-6);
}

TEST(RateTable, asymmetry_is_the_difference_of_the_slopes) {
    Table t;
    for (const double rate : {-3000.0, -2000.0, -1000.0}) t.turn(rate, 50, 0.5 * (1.0 - 20e-6), 1e-5);
    t.turn(0.0, 50, 0.5, 1e-5);
    for (const double rate : {1000.0, 2000.0, 3000.0}) t.turn(rate, 50, 0.5 * (1.0 + 20e-6), 1e-5);
    const RateTable r = rate_table(t.input, t.output);
    ASSERT_TRUE(r.asymmetry_ppm.determined);
    EXPECT_NEAR(r.asymmetry_ppm.value, 40.0, 0.01);
    EXPECT_GT(r.nonlinearity_ppm, 1.0);
}

TEST(RateTable, errors_are_those_of_repeated_tests) {
    double squares_k = 0.0, squares_d = 0.0;
    Table t;
    const int n = 300;
    for (int repeat = 0; repeat < n; ++repeat) {
        t.input.clear();
        t.output.clear();
        for (const double rate :
             {-3000.0, -2000.0, -1500.0, -1000.0, -500.0, 0.0, 500.0, 1000.0, 1500.0, 2000.0, 3000.0})
            t.turn(rate, 30, 0.5, 1.0);
        const RateTable r = rate_table(t.input, t.output);
        squares_k += std::pow((r.scale_factor.value - 0.5) / r.scale_factor.sigma, 2);
        squares_d += std::pow((r.bias_arcsec_s.value - 4.0) / r.bias_arcsec_s.sigma, 2);
    }
    EXPECT_NEAR(squares_k / n, 1.0, 0.3);
    EXPECT_NEAR(squares_d / n, 1.0, 0.3);
}

TEST(RateTable, settling_passages_and_gaps_are_left_out) {
    Table t;
    for (const double rate : {-1000.0, 0.0, 1000.0}) {
        for (int k = 0; k < 10; ++k) t.turn(rate - 100.0 + 10.0 * k, 1, 0.7);
        t.turn(rate, 5, 0.6);
        t.turn(rate, 40, 0.5, 1e-6);
        t.input.push_back(rate);
        t.output.push_back(std::numeric_limits<double>::quiet_NaN());
        t.turn(rate, 40, 0.5, 1e-6);
    }
    const RateTable r = rate_table(t.input, t.output, {.settling_samples = 5});
    ASSERT_EQ(r.stages.size(), 3u);
    EXPECT_EQ(r.stages[0].n_samples, 80);
    EXPECT_NEAR(r.scale_factor.value, 0.5, 1e-8);
}

TEST(RateTable, a_rate_of_the_table_that_is_missing_ends_no_stage) {
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    Table t;
    for (const double rate : {unknown, -1000.0, 0.0, 1000.0}) {
        t.turn(rate, 15, 0.5, 1e-6);
        t.turn(unknown, 2, 0.7);
        t.turn(rate, 15, 0.5, 1e-6);
    }
    const RateTable r = rate_table(t.input, t.output);
    ASSERT_EQ(r.stages.size(), 3u);
    for (const TableStage& s : r.stages) EXPECT_EQ(s.n_samples, 30);
    EXPECT_EQ(r.stages[0].input_arcsec_s, -1000.0);
    EXPECT_NEAR(r.scale_factor.value, 0.5, 1e-8);
    EXPECT_THROW((void)rate_table(std::vector<double>(100, unknown), std::vector<double>(100, 1.0)),
                 deviations::SeriesError);
}

TEST(RateTable, rates_are_one_as_near_as_is_said) {
    Table t;
    for (const double rate : {-1000.0, 0.0, 1000.0}) {
        t.turn(rate, 50);
        t.turn(rate + 5.0, 50);
    }
    EXPECT_EQ(rate_table(t.input, t.output).stages.size(), 6u);
    const RateTable r = rate_table(t.input, t.output, {.same_rate_ratio = 0.01});
    ASSERT_EQ(r.stages.size(), 3u);
    EXPECT_NEAR(r.stages[0].input_arcsec_s, -997.5, 1e-9);
}

TEST(RateTable, stages_of_one_rate_show_their_difference) {
    Table t;
    for (const double rate : {0.0, 1000.0, 2000.0}) t.turn(rate, 50);
    t.turn(1000.0, 50, 0.5 * 1.001);
    EXPECT_NEAR(rate_table(t.input, t.output).hysteresis_arcsec_s, 1.0, 0.01);
}

TEST(RateTable, the_rotation_of_the_earth_is_no_bias) {
    Table t;
    for (const double rate : {-1000.0, 0.0, 1000.0}) t.turn(rate, 50, 0.5, 1e-7);
    const RateTable r = rate_table(t.input, t.output, {.earth_arcsec_s = 4.0});
    ASSERT_TRUE(r.bias_arcsec_s.determined);
    EXPECT_NEAR(r.bias_arcsec_s.value, 0.0, 1e-6);
}

TEST(RateTable, refuses_what_has_no_scale_factor) {
    Table t;
    for (int k = 0; k < 3; ++k) {
        t.turn(100.0, 50);
        t.turn(200.0, 3);
    }
    EXPECT_THROW((void)rate_table(t.input, t.output), deviations::SeriesError);
    EXPECT_THROW((void)rate_table(t.input, std::vector<double>(3)), deviations::SeriesError);
    EXPECT_THROW((void)rate_table({}, {}), deviations::SeriesError);
}

}  // namespace zlg::calibration::rate_table_test
