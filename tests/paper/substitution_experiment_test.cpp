#include <zlg/config/schema.hpp>
#include <zlg/design/error.hpp>
#include <zlg/paper/substitution_experiment.hpp>

#include "phase_regression.hpp"
#include "random_phase_motion.hpp"
#include "test.hpp"

namespace zlg::substitution_experiment_test {

using paper::SubstitutionExperiment;
using paper::SubstitutionPoint;
using paper::SubstitutionResult;

constexpr double count_arcsec = 3.263;
constexpr double paper_tick_s = 0.005;

SubstitutionExperiment experiment(int n, double frequency_hz, double amplitude_arcsec_s, std::uint64_t seed) {
    return {.gap_ticks = n, .frequency_hz = frequency_hz, .amplitude_arcsec_s = amplitude_arcsec_s, .seed = seed};
}

// The highest rate turns by ten whole counts a tick: then the roundings of any two ticks are exactly uncorrelated.
SubstitutionExperiment at_slow_rate(int n, std::uint64_t seed) {
    return {.gap_ticks = n,
            .amplitude_arcsec_s = 0.0,
            .slow_rate_arcsec_s = 10.0 * count_arcsec / paper_tick_s,
            .seed = seed};
}

SubstitutionResult result_of(const SubstitutionExperiment& e) {
    return paper::run_substitution(std::span{&e, 1}, 1).front();
}

// The grids of figs 8-11 of the paper, thinned out.
std::vector<SubstitutionResult> paper_grid() {
    std::vector<SubstitutionExperiment> grid;
    std::uint64_t seed = 0;
    for (const int n : {1, 2, 3})
        for (const double frequency_hz : {2.0, 11.0, 20.0})
            grid.push_back(experiment(n, frequency_hz, 12000.0, ++seed));
    for (const double amplitude : {1000.0, 3000.0, 6000.0, 9000.0})
        grid.push_back(experiment(3, 20.0, amplitude, ++seed));
    for (const int n : {1, 2, 3, 4, 5}) grid.push_back(at_slow_rate(n, ++seed));
    return paper::run_substitution(grid, 2);
}

// 12 000 arcsec/s at 20 Hz, n = 1, 2, 3.
const std::vector<SubstitutionResult>& fast_oscillation() {
    static const auto results =
        paper::run_substitution(std::array{experiment(1, 20.0, 12000.0, 31), experiment(2, 20.0, 12000.0, 32),
                                           experiment(3, 20.0, 12000.0, 33)},
                                2);
    return results;
}

// Constant and linear are the same estimator of the final angle.
std::vector<SubstitutionPoint> final_points(const std::vector<SubstitutionResult>& results) {
    std::vector<SubstitutionPoint> points;
    for (const auto& r : results)
        for (const std::size_t order : {0u, 2u}) points.push_back(r.interpolation[order]);
    return points;
}

std::vector<SubstitutionPoint> real_time_points(const std::vector<SubstitutionResult>& results) {
    std::vector<SubstitutionPoint> points;
    for (const auto& r : results)
        for (const auto& p : r.extrapolation) points.push_back(p);
    return points;
}

// 13 experiments have both components, 5 at a slow rate have one. The orders of one experiment meet the same phases, of
// which most of the chance of an rms is made: its chi-square counts as 18 points rather than orders * 18, with a
// standard deviation of sqrt(2/18) = 0.33, and has the room of two of them about 1.1.
void expect_agreement(const std::vector<SubstitutionPoint>& points, int orders) {
    const auto motion = paper::chi2_per_dof(points);
    EXPECT_EQ(motion.dof, orders * (13 * 2 + 5));
    EXPECT_GT(motion.per_dof, 0.7);
    EXPECT_LT(motion.per_dof, 1.4);
    const auto rms = paper::rms_chi2_per_dof(points);
    EXPECT_EQ(rms.dof, orders * 18);
    EXPECT_GT(rms.per_dof, 0.5);
    EXPECT_LT(rms.per_dof, 1.7);
}

TEST(SubstitutionExperiment, agrees_with_theory_over_the_grids_of_the_paper) {
    const auto results = paper_grid();
    expect_agreement(final_points(results), 2);
    expect_agreement(real_time_points(results), 3);
}

TEST(SubstitutionExperiment, notices_a_theory_that_is_wrong_by_5_percent) {
    auto points = final_points(fast_oscillation());
    EXPECT_LT(paper::chi2_per_dof(points).per_dof, 3.0);
    for (auto& p : points) p.extremum.theory *= 1.05;
    EXPECT_GT(paper::chi2_per_dof(points).per_dof, 100.0);

    points = final_points(fast_oscillation());
    EXPECT_LT(paper::rms_chi2_per_dof(points).per_dof, 4.0);
    for (auto& p : points) p.rms.theory *= 1.05;
    EXPECT_GT(paper::rms_chi2_per_dof(points).per_dof, 8.0);
}

TEST(SubstitutionExperiment, measures_the_worst_errors_of_extrapolation) {
    constexpr std::array<std::array<double, 3>, 3> worst{{{74, 50, 23}, {165, 153, 98}, {259, 312, 260}}};
    for (std::size_t n = 1; n <= 3; ++n)
        for (std::size_t order = 0; order < 3; ++order) {
            const auto& p = fast_oscillation().at(n - 1).extrapolation[order];
            EXPECT_NEAR(std::hypot(p.extremum.arcsec, p.crossing.arcsec), worst[n - 1][order],
                        4.0 * p.extremum.error + 0.5)
                << n << " ticks, order " << order;
        }
}

TEST(SubstitutionExperiment, noise_at_rest_is_the_rounding_of_the_count_through_the_weights) {
    // A reading of the count errs by count/sqrt(12). Constant: each of 2 + 2 ticks n/4, so four readings weigh n/4.
    // Quadratic, n = 3: -1, 5/2 | 5/2, -1, so the readings weigh 1, -7/2, 5/2 on each side.
    const auto check = [](const SubstitutionPoint& p, double noise_arcsec) {
        EXPECT_NEAR(p.noise.theory, noise_arcsec, 1e-3 * noise_arcsec);
        EXPECT_NEAR(p.rms.arcsec, noise_arcsec, 4.0 * p.rms.error);
        EXPECT_LT(p.rms.error, 0.03 * noise_arcsec);
    };
    const auto results = paper::run_substitution(
        std::array{at_slow_rate(1, 41), at_slow_rate(2, 42), at_slow_rate(3, 43), at_slow_rate(5, 44)}, 2);
    for (const auto& r : results) check(r.interpolation[0], r.interpolation[0].n * count_arcsec / std::sqrt(48.0));
    check(results[2].interpolation[2], count_arcsec * std::sqrt(2.0 * (1.0 + 12.25 + 6.25) / 12.0));
}

TEST(SubstitutionExperiment, slow_motion_hides_the_rounding) {
    // 30 arcsec/s at 20 Hz turn by less than 0.05 count a tick: most ticks of a switch read the same rounding.
    auto e = experiment(3, 20.0, 30.0, 7);
    e.switches = 4000;
    const auto p = result_of(e).interpolation[0];
    EXPECT_NEAR(p.rms.arcsec, p.rms.theory, 4.0 * p.rms.error);
    EXPECT_LT(p.rms.arcsec, 0.7 * 3.0 * count_arcsec / std::sqrt(48.0)) << "what independent roundings would make";
}

TEST(SubstitutionExperiment, substituted_ticks_take_over_the_drift) {
    auto e = experiment(3, 20.0, 12000.0, 8);
    e.base.drift = {.magnetic_arcsec_s = 500.0, .magnetic_thermal_arcsec_s = 0.0, .nonmagnetic_arcsec_s = 100.0};
    const auto r = result_of(e);
    // Three ticks of 100 arcsec/s stay. The magnetic drift cancels between the two sides of a gap; the extrapolation
    // sees one side only, with the sign of its mode.
    EXPECT_NEAR(r.interpolation[0].mean.arcsec, 1.5, 4.0 * r.interpolation[0].mean.error);
    EXPECT_NEAR(r.interpolation[0].mean.theory, 1.5, 1e-9);
    EXPECT_LT(r.interpolation[0].noise.arcsec, 1.6);
    EXPECT_LT(r.interpolation[0].noise.theory, 1.6);
    EXPECT_NEAR(r.extrapolation[0].noise.arcsec, 7.5, 0.3);
    EXPECT_NEAR(r.extrapolation[0].noise.theory, 7.5, 0.15);
}

TEST(SubstitutionExperiment, light_noise_comes_in_through_the_re_lock_correction) {
    auto e = at_slow_rate(3, 9);
    e.base.gyro.light_noise_lambda = 0.05;
    const auto r = result_of(e);
    // Variance of a correction (K T chi f0/2)^2 4 s^4/16, in two of four ticks of weight 3/4.
    const double correction = count_arcsec * paper_tick_s * 0.5 * 3.6 * 60e3 * 0.05 * 0.05 / 2.0;
    const double noise = std::hypot(3.0 * count_arcsec / std::sqrt(48.0), std::sqrt(2.0) * 0.75 * correction);
    EXPECT_NEAR(r.interpolation[0].noise.theory, noise, 1e-3 * noise);
    EXPECT_NEAR(r.interpolation[0].rms.arcsec, noise, 4.0 * r.interpolation[0].rms.error);
}

TEST(SubstitutionExperiment, same_bits_on_any_number_of_threads) {
    std::vector<SubstitutionExperiment> experiments;
    for (std::uint64_t k = 0; k < 5; ++k) {
        experiments.push_back(experiment(3, 7.0 + static_cast<double>(k), 12000.0, 20 + k));
        experiments.back().switches = 100;
    }
    const auto one = paper::run_substitution(experiments, 1);
    EXPECT_EQ(one, paper::run_substitution(experiments, 2));
    EXPECT_EQ(one, paper::run_substitution(experiments, 8));
    EXPECT_EQ(one[3], result_of(experiments[3]));
    EXPECT_NE(one[3], one[4]);
    experiments[3].seed = 99;
    EXPECT_NE(one[3], result_of(experiments[3]));
    EXPECT_TRUE(paper::run_substitution({}, 3).empty());
}

TEST(SubstitutionExperiment, refuses_what_is_out_of_range) {
    const auto refused = [](auto change) {
        SubstitutionExperiment e;
        e.switches = 100;
        change(e);
        EXPECT_THROW((void)result_of(e), design::DesignError);
    };
    for (const int n : {0, 99, 100'001}) refused([n](auto& e) { e.switches = n; });
    EXPECT_THROW((void)paper::run_substitution({}, 0), design::DesignError);
}

TEST(SubstitutionExperiment, the_longest_gap_is_measured) {
    auto e = experiment(16, 2.0, 12000.0, 11);
    e.switches = 200;
    // Of a constant: n times the mean of the points, less the sum of the gap, each tick a cosine about the middle.
    const double w = 2.0 * std::numbers::pi * 2.0 * paper_tick_s;
    double sum = 16.0 * (std::cos(8.5 * w) + std::cos(9.5 * w)) / 2.0;
    for (int j = 1; j <= 16; ++j) sum -= std::cos((j - 8.5) * w);
    const auto p = result_of(e).interpolation[0];
    EXPECT_NEAR(p.extremum.arcsec, 12000.0 * paper_tick_s * std::sin(0.5 * w) / (0.5 * w) * sum,
                4.0 * p.extremum.error);
}

TEST(SubstitutionExperiment, a_failure_in_a_thread_reaches_the_caller) {
    std::vector<SubstitutionExperiment> experiments(4);
    for (auto& e : experiments) e.switches = 100;
    experiments[1].switches = 99;
    // No neighbouring mode is reached: the gyro cannot keep to the grid.
    experiments[3].base.piezo.half_wave_error = 0.5;
    for (const int threads : {1, 2, 4})
        EXPECT_THROW((void)paper::run_substitution(experiments, threads), design::DesignError) << "the first of two";
    experiments[1].switches = 100;
    EXPECT_THROW((void)paper::run_substitution(experiments, 2), config::ConfigError);
}

TEST(SubstitutionExperiment, refuses_a_gyro_that_does_not_switch) {
    SubstitutionExperiment e;
    e.switches = 100;
    // The mode runs away from a loop that is too slow to follow: there is no lock from which to switch.
    e.base.perimeter.tau_s = 100.0;
    e.base.perimeter.expansion_lambda_per_c = 1000.0;
    EXPECT_THROW((void)result_of(e), config::ConfigError);

    // A miss beyond the tolerance of lock, and a loop that needs minutes to mend it: one switch, then none.
    e.base.perimeter = {};
    e.base.perimeter.tau_s = 1000.0;
    e.base.piezo.half_wave_error = 0.06;
    test::expect_contains(test::message_of<config::ConfigError>([&] { (void)result_of(e); }),
                          "switched 1 times, allowed is 100");
}

TEST(RandomPhaseMotion, draws_a_phase_for_each_switch) {
    const SubstitutionExperiment e;
    const paper::RandomPhaseMotion motion{e, paper::grid_of(e)};
    double mean = 0.0;
    double square = 0.0;
    double neighbours = 0.0;
    for (int k = 1; k <= e.switches; ++k) {
        const auto q = motion.at(k);
        EXPECT_NEAR(std::hypot(q.sine, q.cosine), 1.0, 1e-12);
        mean += q.sine / e.switches;
        square += q.sine * q.sine / e.switches;
        neighbours += q.sine * motion.at(k + 1).sine / e.switches;
    }
    // Standard deviations sqrt(1/2), sqrt(1/8) and 1/2, over sqrt(2000).
    EXPECT_NEAR(mean, 0.0, 4.0 * 0.0158);
    EXPECT_NEAR(square, 0.5, 4.0 * 0.0079);
    EXPECT_NEAR(neighbours, 0.0, 4.0 * 0.0112);
}

TEST(RandomPhaseMotion, increments_are_differences_of_the_angle) {
    const SubstitutionExperiment e;
    const auto grid = paper::grid_of(e);
    const paper::RandomPhaseMotion motion{e, grid};
    const auto increments = motion.increments_arcsec();
    ASSERT_EQ(increments.size(), 2 * static_cast<std::size_t>(grid.ticks()));
    // Angle -A/w cos(w t + phase), t from the middle of gap 5, tick 5 I + n/2.
    const double w = 2.0 * std::numbers::pi * 20.0;
    const auto angle = [&](double t_s) {
        return -12000.0 / w * (motion.at(5).cosine * std::cos(w * t_s) - motion.at(5).sine * std::sin(w * t_s));
    };
    const auto middle = static_cast<std::size_t>(2 * 5 * grid.interval_ticks + grid.n);
    for (const int half : {-67, -3, 0, 2, 66}) {
        const double t_s = 0.5 * paper_tick_s * half;
        EXPECT_NEAR(increments[middle + static_cast<std::size_t>(half)], angle(t_s + 0.5 * paper_tick_s) - angle(t_s),
                    1e-9);
    }
}

TEST(ChiSquare, is_the_mean_of_squared_deviations_over_errors) {
    const SubstitutionPoint a{.extremum = {5.0, 1.0, 3.0}, .crossing = {1.0, 0.5, 2.0}, .rms = {4.0, 2.0, 10.0}};
    const SubstitutionPoint without_crossing{.extremum = {1.0, 1.0, 0.0}};
    const auto chi2 = paper::chi2_per_dof(std::array{a, without_crossing});
    EXPECT_EQ(chi2.dof, 3);
    EXPECT_DOUBLE_EQ(chi2.per_dof, (4.0 + 4.0 + 1.0) / 3.0);
    EXPECT_EQ(paper::rms_chi2_per_dof(std::array{a, without_crossing}).dof, 1);
    EXPECT_DOUBLE_EQ(paper::rms_chi2_per_dof(std::array{a}).per_dof, 9.0);
    EXPECT_EQ(paper::chi2_per_dof({}).dof, 0);
    EXPECT_EQ(paper::chi2_per_dof({}).per_dof, 0.0);
}

TEST(PhaseRegression, finds_exactly_what_was_put_in) {
    std::vector<paper::Quadratures> at;
    std::vector<double> errors;
    for (const double phase : {0.1, 0.9, 2.0, 2.7, 4.5, 6.0}) {
        at.push_back({std::sin(phase), std::cos(phase)});
        errors.push_back(2.0 + 3.0 * std::sin(phase) - 4.0 * std::cos(phase));
    }
    const auto found = paper::regress(errors, at);
    EXPECT_NEAR(found.mean.value, 2.0, 1e-12);
    EXPECT_NEAR(found.extremum.value, 3.0, 1e-12);
    EXPECT_NEAR(found.crossing.value, -4.0, 1e-12);
    EXPECT_NEAR(found.noise, 0.0, 1e-12);
    EXPECT_NEAR(found.extremum.error, 0.0, 1e-12);
}

TEST(PhaseRegression, has_the_standard_errors_of_a_balanced_design) {
    // Sines of +1 and -1, residuals of +1 and -1 in all combinations, many times over: coefficient error 1/sqrt(N).
    std::vector<paper::Quadratures> at;
    std::vector<double> errors;
    for (int k = 0; k < 250; ++k)
        for (const double sine : {1.0, -1.0})
            for (const double residual : {1.0, -1.0}) {
                at.push_back({sine, 0.0});
                errors.push_back(0.5 * sine + residual);
            }
    const auto found = paper::regress(errors, at);
    EXPECT_NEAR(found.extremum.value, 0.5, 1e-12);
    EXPECT_NEAR(found.extremum.error, 1.0 / std::sqrt(997.0), 1e-9);
    EXPECT_NEAR(found.noise, std::sqrt(1000.0 / 997.0), 1e-12);
    EXPECT_EQ(found.crossing.value, 0.0);
    EXPECT_EQ(found.crossing.error, 0.0);
}

TEST(RootMeanSquare, knows_its_own_spread) {
    const auto even = paper::root_mean_square(std::array{3.0, -3.0, 3.0, -3.0});
    EXPECT_DOUBLE_EQ(even.value, 3.0);
    EXPECT_DOUBLE_EQ(even.error, 0.0);
    // Squares 0 and 4: mean 2, variance 4; 4/(4 * 2 * (2 - 1)).
    const auto uneven = paper::root_mean_square(std::array{0.0, 2.0});
    EXPECT_DOUBLE_EQ(uneven.value, std::sqrt(2.0));
    EXPECT_DOUBLE_EQ(uneven.error, std::sqrt(0.5));
}

}  // namespace zlg::substitution_experiment_test
