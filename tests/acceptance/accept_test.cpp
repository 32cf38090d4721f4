#include <zlg/acceptance/accept.hpp>
#include <zlg/config/schema.hpp>
#include <zlg/noise/mean_error.hpp>

#include "records.hpp"

namespace zlg::accept_test {

using namespace acceptance_test;
using acceptance::Verdict;

constexpr double n_per_s = 10.0;

// Stages of 60 s, one after the other; the gyro shows `scale` of each and noise of 1 deg/h a sample.
struct Table {
    std::string stages;
    std::vector<double> shown;
};

Table table(const std::vector<double>& rates_deg_s, double scale, double cubic = 0.0) {
    Table t;
    const std::vector<double> noise = white(rates_deg_s.size() * 600, 1.0);
    for (std::size_t k = 0; k < rates_deg_s.size(); ++k) {
        t.stages += fmt::format("{}{{ from_s = {}, to_s = {}, rate_deg_s = {} }}", k == 0 ? "" : ", ", 60 * k,
                                60 * (k + 1), rates_deg_s[k]);
        const double rate = 3600.0 * rates_deg_s[k], bent = rate + cubic * rate * rate * rate;
        for (std::size_t j = 0; j < 600; ++j) t.shown.push_back(scale * bent + noise[k * 600 + j]);
    }
    t.stages = fmt::format("stages = [{}]\n", t.stages);
    return t;
}

TEST(Accept, a_rate_table_tells_the_scale_factor_within_its_error) {
    const Table t = table({-10, -5, -2, 0, 2, 5, 10}, 1.0 + 50e-6);
    write("table.csv", {t.shown});
    const auto test = accepted(run("rate_table", "table.csv", t.stages),
                               "'scale_factor.ppm' = { min = 45, max = 55 }\n'scale_nonlinearity.ppm' = { max = 5 }\n");
    const auto& scale = of(test, "scale_factor.ppm");
    EXPECT_LT(std::abs(scale.value.value - 50.0), 4.0 * scale.value.uncertainty);
    // 1 deg/h/sqrt(600) a stage; sum of the squared rates in deg/h: 258 * 3600^2.
    EXPECT_NEAR(scale.value.uncertainty, 1e6 / std::sqrt(600.0 * 258.0) / 3600.0, 0.5);
    EXPECT_EQ(scale.value.degrees, 5.0);
    EXPECT_EQ(scale.verdict, Verdict::pass);
    EXPECT_EQ(of(test, "scale_nonlinearity.ppm").verdict, Verdict::pass);
    EXPECT_TRUE(test.passed());
}

// y = x + c x^3 about its straight line: the residuals by hand, of the inputs -3 -2 -1 0 1 2 3 in units of 10/3 deg/s.
TEST(Accept, a_bend_is_a_nonlinearity) {
    const double unit = 36000.0 / 3.0, cubic = 1e-3 / (unit * unit);
    std::vector<double> rates;
    for (int k = -3; k <= 3; ++k) rates.push_back(10.0 * k / 3.0);
    const Table t = table(rates, 1.0, cubic);
    write("table.csv", {t.shown});
    const auto test = accepted(run("rate_table", "table.csv", t.stages));
    // Slope of k^3 over k: 196/28 = 7; residuals k^3 - 7k: -6, 6, 6, 0, -6, -6, 6. Of the largest output 3.021.
    const double slope = 1.0 + 7e-3, expected = 1e6 * 1e-3 * std::sqrt(6.0 * 36.0 / 5.0) / (3.0 * slope);
    EXPECT_NEAR(of(test, "scale_nonlinearity.ppm").value.value, expected, 0.01 * expected);
}

TEST(Accept, a_table_that_stands_or_turns_the_other_way_is_no_measurement) {
    Table t = table({-10, -5, 0, 5, 10}, -1.0);
    write("table.csv", {t.shown});
    const std::string runs = run("rate_table", "table.csv", t.stages);
    EXPECT_NE(of(accepted(runs), "scale_factor.ppm").value.reason.find("against the table"), std::string::npos);
    write("table.csv", {white(t.shown.size(), 1.0)});
    EXPECT_NE(of(accepted(runs), "scale_factor.ppm").value.reason.find("the table stood"), std::string::npos);
    for (double& rate : t.shown) rate *= -1.5;
    write("table.csv", {t.shown});
    EXPECT_NE(of(accepted(runs), "scale_factor.ppm").value.reason.find("unit, or the sensor"), std::string::npos);
}

TEST(Accept, stages_beyond_the_record_are_refused) {
    const Table t = table({-10, -5, 0, 5, 10}, 1.0);
    write("table.csv", {std::vector<double>(t.shown.begin(), t.shown.end() - 300)});
    try {
        (void)accepted(run("rate_table", "table.csv", t.stages));
        ADD_FAILURE() << "taken";
    } catch (const config::ConfigError& error) {
        EXPECT_NE(std::string{error.what()}.find("[[run]] 1: stages end at 300 s, and the record at 270 s"),
                  std::string::npos)
            << error.what();
    }
}

TEST(Accept, the_threshold_is_the_least_rate_that_shows) {
    Table t = table({10, 1, 0.01, 0.005, 0, -0.005, -0.01, -1, -10}, 1.0);
    // Below 0.008 deg/s it shows nothing.
    for (std::size_t k = 600 * 3; k < 600 * 6; ++k) t.shown[k] = std::fmod(t.shown[k], 18.0) * 0.1;
    write("table.csv", {t.shown});
    const auto test = accepted(run("rate_table", "table.csv", t.stages));
    EXPECT_EQ(of(test, "threshold.deg_h").value.value, 36.0);
}

TEST(Accept, a_bias_that_follows_the_temperature_has_its_slope_and_its_hysteresis) {
    const std::size_t n = 36000;
    std::vector<double> rates = white(n, 1.0), temperature(n);
    for (std::size_t k = 0; k < n; ++k) {
        const bool warms = k < n / 2;
        temperature[k] = 20.0 + 40.0 * static_cast<double>(warms ? k : n - k) / static_cast<double>(n);
        rates[k] += 0.3 * temperature[k] + (warms ? 0.1 : -0.1);
    }
    write("warm.csv", {rates, temperature});
    const auto test = accepted(run("temperature", "warm.csv", "temperature_c = 2\n"));
    const auto &slope = of(test, "bias_temperature.deg_h_c").value, &width = of(test, "bias_hysteresis.deg_h").value;
    EXPECT_LT(std::abs(slope.value - 0.3), 4.0 * slope.uncertainty);
    EXPECT_LT(std::abs(width.value - 0.2), 4.0 * width.uncertainty);
    EXPECT_LT(slope.uncertainty, 0.01);
    EXPECT_LT(width.uncertainty, 0.1);
}

// Four hours at 10 Hz from cold: sums of a exp(-t/tau).
acceptance::Value warmed(const std::vector<std::pair<double, double>>& parts, std::size_t n, double band = 0.1) {
    std::vector<double> rates = white(n, 1.0);
    for (std::size_t k = 0; k < n; ++k)
        for (const auto& [a, tau_s] : parts) rates[k] += a * std::exp(-static_cast<double>(k) / n_per_s / tau_s);
    write("cold.csv", {rates});
    return of(accepted(run("warm_up", "cold.csv"), "", fmt::format("warm_up_band_deg_h = {}\n", band)), "warm_up.s")
        .value;
}

// 5 exp(-t/300 s) is below 0.1 from 300 ln 50 = 1173.6 s on.
TEST(Accept, warming_takes_until_it_is_within_the_band) {
    const acceptance::Value time = warmed({{5.0, 300.0}}, 144000);
    ASSERT_TRUE(time.determined) << time.reason;
    EXPECT_LT(std::abs(time.value - 300.0 * std::log(50.0)), 3.0 * time.uncertainty);
    EXPECT_LT(time.uncertainty, 100.0);
    EXPECT_NE(of(accepted(run("warm_up", "cold.csv")), "warm_up.s").value.reason.find("warm_up_band_deg_h"),
              std::string::npos);
}

// 0.3 exp(-t/2275 s) is below 0.1 from 2275 ln 3 = 2499 s on, when the quick part has long been over.
TEST(Accept, a_slow_part_of_the_warming_is_waited_for) {
    const double truth = 2275.0 * std::log(3.0);
    const acceptance::Value time = warmed({{5.0, 50.0}, {0.3, 2275.0}}, 144000);
    ASSERT_TRUE(time.determined) << time.reason;
    EXPECT_LT(std::abs(time.value - truth), 2.0 * time.uncertainty);
    // That long a run alone does not show its end.
    EXPECT_FALSE(warmed({{5.0, 50.0}, {0.3, 2275.0}}, 30000).determined);
}

TEST(Accept, a_gyro_that_does_not_warm_is_ready_where_its_noise_shows_that) {
    write("cold.csv", {white(36000, 1.0)});
    const auto of_band = [](const char* band) {
        return of(accepted(run("warm_up", "cold.csv"), "", fmt::format("warm_up_band_deg_h = {}\n", band)), "warm_up.s")
            .value;
    };
    EXPECT_EQ(of_band("1").value, 0.0);
    EXPECT_FALSE(of_band("0.01").determined);
}

TEST(Accept, a_field_moves_the_bias_by_its_sensitivity) {
    std::string runs;
    for (int k = 0; k < 3; ++k) {
        std::vector<double> rates = white(6000, 1.0, static_cast<std::uint64_t>(k + 1));
        for (double& rate : rates) rate += 0.5 + 2.0 * 0.1 * k;
        write(fmt::format("field_{}.csv", k), {rates});
        runs += run("magnetic", fmt::format("field_{}.csv", k), fmt::format("field_mt = {}\n", 0.1 * k));
    }
    const auto test = accepted(runs);
    const auto& slope = of(test, "magnetic_sensitivity.deg_h_mt").value;
    EXPECT_LT(std::abs(slope.value - 2.0), 4.0 * slope.uncertainty);
    // 1/sqrt(6000) each, at -0.1, 0 and 0.1 mT, and what slow noise may hide under the white noise.
    const double white_alone = 1.0 / std::sqrt(6000.0) / std::sqrt(0.02);
    EXPECT_GT(slope.uncertainty, white_alone);
    EXPECT_LT(slope.uncertainty, 3.0 * white_alone);
    EXPECT_LT(slope.degrees, 10.0);
    EXPECT_EQ(of(test, "magnetic_residual.deg_h").value.degrees, 1.0);
}

TEST(Accept, the_error_of_a_bias_is_that_of_its_mean) {
    const std::vector<double> rates = white(5000, 1.0);
    write("mean.csv", {rates});
    const acceptance::Value bias = of(accepted(run("static", "mean.csv")), "bias.deg_h").value;
    const noise::MeanError error = noise::mean_error(rates);
    EXPECT_NEAR(bias.uncertainty, error.sigma, 1e-6 * error.sigma);
    EXPECT_NEAR(bias.degrees, error.degrees, 1e-6 * error.degrees);
}

TEST(Accept, a_stretch_that_stands_twice_is_no_measurement) {
    const auto bias = [](const std::vector<double>& rates) {
        write("rest.csv", {rates});
        return of(accepted(run("static", "rest.csv")), "bias.deg_h").value;
    };
    std::vector<double> rates = white(5000, 1.0);
    rates.insert(rates.end(), rates.begin() + 1000, rates.begin() + 1500);
    EXPECT_NE(bias(rates).reason.find("samples 5001 to 5500 are those from 1001 on once more"), std::string::npos)
        << bias(rates).reason;
    // Of a few values each many a stretch stands twice.
    std::vector<double> coarse = white(20000, 0.5);
    for (double& rate : coarse) rate = std::round(rate);
    EXPECT_TRUE(bias(coarse).determined) << bias(coarse).reason;
    coarse.insert(coarse.end(), coarse.begin(), coarse.begin() + 9000);
    EXPECT_NE(bias(coarse).reason.find("once more"), std::string::npos);
}

TEST(Accept, one_missing_sample_in_a_hundred_is_borne_and_more_are_not) {
    const auto bias = [](std::size_t every) {
        std::vector<double> rates = white(5000, 1.0);
        for (std::size_t k = every; k < rates.size(); k += every) rates[k] = NAN;
        write("rest.csv", {rates});
        return of(accepted(run("static", "rest.csv")), "bias.deg_h").value;
    };
    EXPECT_TRUE(bias(101).determined);
    EXPECT_NE(bias(98).reason.find("51 of 5000 samples are missing; allowed is one in 100"), std::string::npos);
}

// The slope is the mean of the runs, the hysteresis and the time of warming the largest of them.
TEST(Accept, several_runs_are_one_gyro) {
    std::string runs;
    for (std::uint64_t r = 1; r <= 2; ++r) {
        const std::size_t n = 36000;
        std::vector<double> rates = white(n, 1.0, r), temperature(n);
        for (std::size_t k = 0; k < n; ++k) {
            const bool warms = k < n / 2;
            temperature[k] = 20.0 + 40.0 * static_cast<double>(warms ? k : n - k) / static_cast<double>(n);
            rates[k] += 0.1 * static_cast<double>(r) * temperature[k] + (warms ? 0.5 : -0.5) * static_cast<double>(r);
        }
        write(fmt::format("warm_{}.csv", r), {rates, temperature});
        runs += run("temperature", fmt::format("warm_{}.csv", r), "temperature_c = 2\n");
        std::vector<double> cold = white(144000, 1.0, r + 2);
        for (std::size_t k = 0; k < cold.size(); ++k)
            cold[k] += 5.0 * std::exp(-static_cast<double>(k) / n_per_s / (200.0 * static_cast<double>(r)));
        write(fmt::format("cold_{}.csv", r), {cold});
        runs += run("warm_up", fmt::format("cold_{}.csv", r));
    }
    const auto test = accepted(runs, "", "warm_up_band_deg_h = 0.1\n");
    const auto &slope = of(test, "bias_temperature.deg_h_c").value, &width = of(test, "bias_hysteresis.deg_h").value,
               &time = of(test, "warm_up.s").value;
    EXPECT_NEAR(slope.value, 0.15, 0.01);
    // They differ by more than their noise: 0.1 apart, 0.05 of the mean of two, with one degree.
    EXPECT_NEAR(slope.uncertainty, 0.05, 0.01);
    EXPECT_EQ(slope.degrees, 1.0);
    EXPECT_LT(std::abs(width.value - 2.0), 4.0 * width.uncertainty);
    EXPECT_LT(std::abs(time.value - 400.0 * std::log(50.0)), 2.0 * time.uncertainty);
}

TEST(Accept, a_unit_that_does_not_pass_has_no_risk) {
    write("rest.csv", {white(5000, 1.0)});
    const auto risk = [](const char* limit) {
        return accepted(run("static", "rest.csv"), fmt::format("'bias.deg_h' = {{ max = {} }}\n", limit)).unit_risk;
    };
    ASSERT_TRUE(risk("1"));
    EXPECT_LT(*risk("1"), 0.05);
    EXPECT_FALSE(risk("0"));
    EXPECT_FALSE(risk("-1"));
}

TEST(Accept, what_no_run_gives_says_what_it_needs) {
    write("rest.csv", {white(2000, 1.0)});
    const auto test = accepted(run("static", "rest.csv"));
    EXPECT_EQ(test.quantities.size(), acceptance::quantities().size());
    EXPECT_EQ(of(test, "scale_factor.ppm").verdict, Verdict::not_determined);
    EXPECT_EQ(of(test, "scale_factor.ppm").value.reason, "needs a rate table of three stages or more");
    EXPECT_FALSE(test.passed());
    EXPECT_FALSE(test.figures.empty());
}

}  // namespace zlg::accept_test
