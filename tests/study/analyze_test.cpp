#include <fmt/format.h>

#include <zlg/config/schema.hpp>
#include <zlg/noise/mean_error.hpp>
#include <zlg/report/page.hpp>
#include <zlg/study/analyze.hpp>

#include "test.hpp"

namespace zlg::analyze_test {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

study::AxisRecord white(std::size_t n, double mean, double deviation, unsigned seed) {
    std::mt19937 engine(seed);
    std::normal_distribution<double> normal;
    study::AxisRecord axis{.name = "axis", .group = "unit", .holds = "rates", .rate_hz = 10.0};
    for (std::size_t k = 0; k < n; ++k) axis.rates_arcsec_s.push_back(mean + deviation * normal(engine));
    return axis;
}

std::string complaint(study::AxisRecord axis, const config::Analysis& c = {}) {
    return test::refusal_by<deviations::SeriesError>(
        [&] { (void)study::analyze_axis({.config = c}, std::move(axis)); });
}

double sigma_of(const std::vector<double>& rates) { return noise::mean_error(rates).sigma; }

TEST(Analyze, white_noise_with_gaps) {
    study::AxisRecord axis = white(20000, 5.0, 2.0, 1);
    for (std::size_t k = 5000; k < 5100; ++k) axis.rates_arcsec_s[k] = missing;
    for (std::size_t k = 9000; k < 9003; ++k) axis.rates_arcsec_s[k] = missing;
    const double sigma = sigma_of(axis.rates_arcsec_s);
    const auto r = study::analyze_axis({}, std::move(axis));
    EXPECT_EQ(r.n_samples, 20000);
    EXPECT_EQ(r.n_known, 19897);
    ASSERT_EQ(r.n_gaps, 2);
    EXPECT_DOUBLE_EQ(r.gaps[0].from_s, 500.0);
    EXPECT_DOUBLE_EQ(r.gaps[0].to_s, 510.0);
    // The mean is that of white noise; its error cannot know that.
    EXPECT_EQ(r.mean_sigma_arcsec_s, sigma);
    EXPECT_GT(sigma, 2.0 / std::sqrt(19897.0));
    EXPECT_NEAR(r.mean_arcsec_s, 5.0, 4.0 * 2.0 / std::sqrt(19897.0));
    ASSERT_FALSE(r.readouts.empty());
    EXPECT_EQ(r.readouts[0].what, "at 1 s");
    EXPECT_NEAR(r.readouts[0].deviation_arcsec_s, 2.0 / std::sqrt(10.0), 0.03);
}

TEST(Analyze, a_sinusoid_is_no_part_of_the_mean) {
    study::AxisRecord axis = white(20003, 5.0, 2.0, 19);
    const double still = sigma_of(axis.rates_arcsec_s);
    double shaken = 0.0;
    for (std::size_t k = 0; k < axis.rates_arcsec_s.size(); ++k) {
        const double sine = 1000.0 * std::sin(0.3 * static_cast<double>(k));
        axis.rates_arcsec_s[k] += sine;
        // Gaps at the crests alone.
        if (k % 500 < 100 && sine > 800.0)
            axis.rates_arcsec_s[k] = missing;
        else
            shaken += sine;
    }
    const auto r = study::analyze_axis({}, std::move(axis));
    ASSERT_TRUE(r.fit);
    EXPECT_LT(shaken / static_cast<double>(r.n_known), -10.0);
    EXPECT_NEAR(r.mean_sigma_arcsec_s, still, 0.1 * still);
    EXPECT_NEAR(r.mean_arcsec_s, 5.0, 4.0 * 2.0 / std::sqrt(20000.0));
}

TEST(Analyze, gaps_break_the_line_of_the_course) {
    study::AxisRecord axis = white(3000, 0.0, 1.0, 2);
    for (std::size_t k = 1000; k < 1200; ++k) axis.rates_arcsec_s[k] = missing;
    const auto r = study::analyze_axis({}, std::move(axis));
    int broken = 0;
    for (const auto& bin : r.time_bins) broken += std::isnan(bin.mean_arcsec_s) ? 1 : 0;
    EXPECT_EQ(broken, 100);
}

TEST(Analyze, three_axes_see_the_rate_of_the_earth) {
    std::vector<study::AxisResult> axes;
    for (const double mean : {-12.0, 3.0, 8.5}) axes.push_back(study::analyze_axis({}, white(5000, mean, 1.0, 3)));
    const auto lines = study::earth_lines(axes);
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_NEAR(lines[0].norm_arcsec_s, std::sqrt(144.0 + 9.0 + 72.25), 0.05);
    EXPECT_NEAR(lines[0].sigma_arcsec_s, axes[0].mean_sigma_arcsec_s, 1e-3);
    axes.pop_back();
    EXPECT_TRUE(study::earth_lines(axes).empty());
}

TEST(Analyze, a_switched_gyro_is_split_and_its_sawtooth_taken_out) {
    study::AxisRecord axis = white(40000, 0.0, 1.0, 4);
    for (std::size_t k = 0; k < axis.rates_arcsec_s.size(); ++k) {
        axis.mode.push_back((k / 1000) % 2 == 0 ? 1 : -1);
        axis.rates_arcsec_s[k] += axis.mode.back();
        if (k >= 1000 && k % 1000 < 3) axis.rates_arcsec_s[k] = missing;
    }
    const auto r = study::analyze_axis({}, std::move(axis));
    ASSERT_TRUE(r.modes);
    EXPECT_NEAR(r.modes->magnetic_arcsec_s.value, 1.0, 4.0 * r.modes->magnetic_arcsec_s.sigma);
    ASSERT_EQ(r.mode_curves.size(), 3u);
    // At one segment's length the sawtooth is all; without it white noise is left.
    const auto at = [](const deviations::DeviationCurve& c, std::int64_t m) {
        for (const auto& p : c.points)
            if (p.m == m) return p.deviation;
        return missing;
    };
    EXPECT_GT(at(r.curves[0], 1024), 0.5);
    EXPECT_NEAR(at(r.mode_curves[2], 1024), 1.0 / std::sqrt(1024.0), 0.01);
}

TEST(Analyze, deviations_and_taus_are_those_asked_for) {
    config::Analysis c;
    c.deviations = {config::Deviation::mdev, config::Deviation::hdev};
    c.taus_s = {0.5, 2.0};
    const auto r = study::analyze_axis({.config = c}, white(2000, 0.0, 1.0, 5));
    ASSERT_EQ(r.curves.size(), 2u);
    EXPECT_EQ(r.curves[0].kind, deviations::DeviationKind::mdev);
    ASSERT_EQ(r.curves[1].points.size(), 2u);
    EXPECT_EQ(r.curves[1].points[1].m, 20);
}

config::Analysis asking(std::vector<config::Deviation> deviations) {
    config::Analysis c;
    c.deviations = std::move(deviations);
    return c;
}

TEST(Analyze, readouts_are_of_the_allan_deviation_whatever_is_asked_for) {
    // A rate that walks by K = 1 arcsec/s/sqrt(s): Allan K sqrt(3/3) at 3 s, Hadamard K sqrt(3/6).
    study::AxisRecord walk = white(300000, 0.0, std::sqrt(0.1), 12);
    double rate = 0.0;
    for (double& r : walk.rates_arcsec_s) r = rate += r;
    using enum config::Deviation;
    for (const auto& asked :
         {std::vector{ohdev}, std::vector{mdev}, std::vector{tdev, hdev}, std::vector{tdev, adev}}) {
        const auto r = study::analyze_axis({.config = asking(asked)}, walk);
        ASSERT_TRUE(r.fit);
        bool is_read = false;
        for (const auto& readout : r.readouts)
            if (readout.what == "where rate random walk is read") {
                is_read = true;
                EXPECT_NEAR(readout.deviation_arcsec_s, 1.0, 0.03);
            }
        EXPECT_TRUE(is_read);
        EXPECT_EQ(r.allan.kind,
                  asked.back() == adev ? deviations::DeviationKind::adev : deviations::DeviationKind::oadev);
    }
}

// No fit finds a walk that crosses the white noise at 1/16 of the record, and the error of the mean has to know of it.
TEST(Analyze, the_error_of_the_mean_counts_slow_noise_whatever_is_asked_for) {
    study::AxisRecord axis = white(4096, 0.0, 3.0, 13);
    const study::AxisRecord steps = white(4096, 0.0, 3.0 * std::sqrt(3.0) / 256.0, 23);
    double walk = 0.0;
    for (std::size_t k = 0; k < 4096; ++k) axis.rates_arcsec_s[k] += walk += steps.rates_arcsec_s[k];
    for (const auto kind : {config::Deviation::oadev, config::Deviation::tdev})
        for (const bool with_page : {true, false}) {
            const auto r = study::analyze_axis({.config = asking({kind}), .with_page = with_page}, axis);
            EXPECT_EQ(r.mean_sigma_arcsec_s, sigma_of(axis.rates_arcsec_s));
            EXPECT_EQ(r.mean_degrees, noise::mean_error(axis.rates_arcsec_s).degrees);
        }
    EXPECT_GT(sigma_of(axis.rates_arcsec_s), 4.0 * 3.0 / std::sqrt(4096.0));
}

// The drift of the mode, in step with it, is in every such mean; that of the temperature is in this one.
TEST(Analyze, the_error_of_the_mean_is_without_the_magnetic_drift_and_with_that_of_the_temperature) {
    study::AxisRecord axis = white(40000, 0.0, 1.0, 21), switched = axis, warm = axis;
    for (std::size_t k = 0; k < axis.rates_arcsec_s.size(); ++k) {
        switched.mode.push_back((k / 3000) % 2 == 0 ? 1 : -1);
        switched.rates_arcsec_s[k] += 10.0 * switched.mode.back();
        warm.temperature_c.push_back(20.0 + 1e-3 * static_cast<double>(k));
        warm.rates_arcsec_s[k] += 2.0 * (warm.temperature_c[k] - 40.0);
    }
    const double quiet = sigma_of(axis.rates_arcsec_s);
    EXPECT_NEAR(study::analyze_axis({}, switched).mean_sigma_arcsec_s, quiet, 0.1 * quiet);
    EXPECT_GT(sigma_of(switched.rates_arcsec_s), 10.0 * quiet);
    const double drifting = sigma_of(warm.rates_arcsec_s);
    EXPECT_GT(drifting, 10.0 * quiet);
    EXPECT_NEAR(study::analyze_axis({}, warm).mean_sigma_arcsec_s, drifting, 1e-9 * drifting);
}

TEST(Analyze, a_missing_angle_costs_three_differences_at_every_averaging) {
    study::AxisRecord axis = white(1000, 0.0, 1.0, 14);
    std::vector<double> angle{5.0};
    for (const double r : axis.rates_arcsec_s) angle.push_back(angle.back() + r / axis.rate_hz);
    angle[500] = axis.rates_arcsec_s[499] = axis.rates_arcsec_s[500] = missing;
    axis.phase_arcsec = angle;
    const auto r = study::analyze_axis({}, axis);
    EXPECT_EQ(r.n_known, 998);
    for (const auto& p : r.curves.front().points) {
        const auto m = static_cast<std::size_t>(p.m);
        double squares = 0.0, n = 0.0;
        for (std::size_t k = 0; k + 2 * m < angle.size(); ++k) {
            const double d = angle[k + 2 * m] - 2.0 * angle[k + m] + angle[k];
            if (std::isfinite(d)) squares += d * d, n += 1.0;
        }
        EXPECT_EQ(static_cast<double>(p.terms), n);
        EXPECT_NEAR(p.deviation, std::sqrt(squares / n / 2.0) / p.tau_s, 1e-9 * p.deviation);
    }
}

TEST(Analyze, a_switched_gyro_without_noise_has_no_terms_and_the_reason) {
    study::AxisRecord axis = white(20000, 0.0, 0.0, 16);
    for (std::size_t k = 0; k < axis.rates_arcsec_s.size(); ++k) {
        axis.mode.push_back((k / 1000) % 2 == 0 ? 1 : -1);
        axis.rates_arcsec_s[k] = 0.5 * axis.mode.back();
    }
    const auto r = study::analyze_axis({}, std::move(axis));
    EXPECT_EQ(r.curves.size(), 1u);
    ASSERT_TRUE(r.modes);
    EXPECT_NEAR(r.modes->fitted_magnetic, 0.5, 1e-12);
    EXPECT_FALSE(r.fit);
    EXPECT_NE(r.no_fit.find("without the magnetic drift"), std::string::npos) << r.no_fit;
    study::AnalysisResult result;
    result.axes.push_back(r);
    const std::string page = report::html(study::analysis_page({}, result));
    for (const char* word : {"nan", "NaN", ">inf", "-inf"}) EXPECT_EQ(page.find(word), std::string::npos) << word;
}

TEST(Analyze, the_error_of_an_angle_is_no_axis_of_the_unit) {
    std::vector<study::AxisResult> axes;
    for (const double mean : {-12.0, 3.0, 8.5}) {
        axes.push_back(study::analyze_axis({}, white(1000, mean, 1.0, 17)));
        study::AxisRecord error = white(1000, 0.0, 1.0, 18);
        error.is_error = true;
        axes.push_back(study::analyze_axis({}, std::move(error)));
    }
    const auto lines = study::earth_lines(axes);
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_EQ(lines[0].n_axes, 3);
    EXPECT_NEAR(lines[0].norm_arcsec_s, std::sqrt(144.0 + 9.0 + 72.25), 0.2);
}

class Kalibr : public ::testing::Test {
protected:
    static noise::FittedTerm walk(double limit) { return {.kind = noise::NoiseKind::rate_random_walk, .limit = limit}; }
    static study::AxisResult axis(double n, double k, double limit) {
        study::AxisResult a;
        a.name = "unit";
        a.rate_hz = 100.0;
        a.fit.emplace();
        a.fit->terms.angle_random_walk_arcsec_sqrt_s = n;
        a.fit->terms.rate_random_walk_arcsec_s_sqrt_s = k;
        a.fit->fitted = {walk(limit)};
        return a;
    }
    static std::string refusal(const std::vector<study::AxisResult>& axes) {
        return test::refusal_by<deviations::SeriesError>([&] { (void)study::kalibr_gyro(axes); });
    }
    static constexpr double rad = 3.14159265358979323846 / 648000.0;
};

TEST_F(Kalibr, is_told_the_largest_that_was_found) {
    const auto g = study::kalibr_gyro({axis(0.3, 0.0, 0.9), axis(0.1, 0.02, missing), axis(0.2, 0.01, missing)});
    EXPECT_DOUBLE_EQ(g.noise_density_rad_s_sqrt_hz, 0.3 * rad);
    EXPECT_DOUBLE_EQ(g.random_walk_rad_s2_sqrt_hz, 0.02 * rad);
    EXPECT_FALSE(g.random_walk_is_limit);
}

TEST_F(Kalibr, is_told_the_limit_where_no_walk_was_found) {
    const auto g = study::kalibr_gyro({axis(0.3, 0.0, 0.004), axis(0.1, 0.0, 0.007)});
    EXPECT_DOUBLE_EQ(g.random_walk_rad_s2_sqrt_hz, 0.007 * rad);
    EXPECT_TRUE(g.random_walk_is_limit);
}

TEST_F(Kalibr, is_told_nothing_that_is_not_known) {
    EXPECT_NE(refusal({axis(0.3, 0.0, missing)}).find("rate random walk"), std::string::npos);
    EXPECT_NE(refusal({axis(0.0, 0.1, missing)}).find("no angle random walk"), std::string::npos);
    auto moved = axis(0.3, 0.1, missing);
    moved.fit->describes = false;
    EXPECT_NE(refusal({axis(0.3, 0.1, missing), moved}).find("unit: the fitted terms do not describe"),
              std::string::npos);
    auto error = axis(0.2, 0.1, missing);
    error.is_error = true;
    EXPECT_EQ(refusal({moved, error}), "");
    auto bare = axis(0.0, 0.0, missing);
    bare.fit.reset();
    bare.no_fit = "too short";
    EXPECT_NE(refusal({bare}).find("unit: no terms are fitted: too short"), std::string::npos);
    EXPECT_NE(refusal({}), "");
}

TEST(Analyze, what_cannot_be_analysed_is_one_line_with_its_name) {
    EXPECT_NE(complaint(white(1, 0.0, 1.0, 6)).find("axis: "), std::string::npos);
    EXPECT_NE(complaint(white(100, 5.0, 0.0, 7)).find("axis: "), std::string::npos);
    study::AxisRecord unknown = white(100, 0.0, 1.0, 8);
    for (double& r : unknown.rates_arcsec_s) r = missing;
    EXPECT_NE(complaint(unknown).find("axis: "), std::string::npos);
}

TEST(Analyze, a_short_record_has_deviations_but_no_terms) {
    const auto r = study::analyze_axis({}, white(20, 0.0, 1.0, 9));
    EXPECT_FALSE(r.fit);
    EXPECT_NE(r.no_fit.find("64"), std::string::npos);
    EXPECT_GT(r.mean_sigma_arcsec_s, 0.0);
}

TEST(Analyze, no_page_has_a_number_that_is_none) {
    study::AnalysisResult result;
    result.axes.push_back(study::analyze_axis({}, white(20, 0.0, 1.0, 10)));
    result.axes.push_back(study::analyze_axis({}, white(3000, 1.0, 1.0, 11)));
    const std::string page = report::html(study::analysis_page({}, result));
    for (const char* word : {"nan", "NaN", ">inf", "-inf"}) EXPECT_EQ(page.find(word), std::string::npos) << word;
    EXPECT_NE(page.find("id=\"sigma-2\""), std::string::npos);
}

TEST(Analyze, a_page_gives_tdev_in_its_own_unit) {
    config::Analysis c = asking({config::Deviation::tdev});
    c.unit = config::ShownRate::rad_s;
    study::AnalysisResult result;
    result.axes.push_back(study::analyze_axis({.config = c}, white(500, 0.0, 1.0, 20)));
    const std::string page = report::html(study::analysis_page(c, result));
    EXPECT_NE(page.find("tdev, arcsec; intervals of 95 %"), std::string::npos);
    EXPECT_NE(page.find(fmt::format("{:.4g}", result.axes[0].curves[0].points[0].deviation)), std::string::npos);
    EXPECT_NE(page.find("Allan deviation, oadev"), std::string::npos);
}

TEST(Analyze, rates_are_shown_in_the_unit_asked_for) {
    EXPECT_DOUBLE_EQ(study::shown_rate(config::ShownRate::deg_s, 7200.0), 2.0);
    EXPECT_DOUBLE_EQ(study::shown_rate(config::ShownRate::deg_h, 3.0), 3.0);
    EXPECT_NEAR(study::shown_rate(config::ShownRate::rad_s, 648000.0), 3.14159265, 1e-8);
    EXPECT_EQ(study::shown_unit(config::ShownRate::rad_s), "rad/s");
}

}  // namespace zlg::analyze_test
