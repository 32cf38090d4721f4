#include "accuracy/manoeuvres.hpp"

#include "accuracy/parts.hpp"
#include "test.hpp"

namespace zlg::trials::manoeuvres_test {

constexpr ManoeuvreLaw laws[] = {ManoeuvreLaw::ramp, ManoeuvreLaw::linear, ManoeuvreLaw::exponential,
                                 ManoeuvreLaw::pulse};

// Rate of each law, by its definition.
double rate(ManoeuvreLaw law, double x) {
    constexpr double pi = 3.14159265358979;
    if (x <= 0.0) return 0.0;
    if (law == ManoeuvreLaw::exponential) return 1.0 - std::exp(-3.0 * x);
    if (law == ManoeuvreLaw::pulse) return x < 1.0 ? 0.5 * (1.0 - std::cos(2.0 * pi * x)) : 0.0;
    if (x >= 1.0) return 1.0;
    return law == ManoeuvreLaw::linear ? x : 0.5 * (1.0 - std::cos(pi * x));
}

TEST(Manoeuvres, TheAngleIsTheIntegralOfTheRate) {
    for (const ManoeuvreLaw law : laws) {
        for (const double duration_s : {0.02, 0.3}) {
            double sum = 0.0;
            constexpr int steps = 20000;
            for (int k = 0; k < steps; ++k) {
                const double dt = 3.0 * duration_s / steps;
                sum += dt * rate(law, (k + 0.5) * dt / duration_s);
                EXPECT_NEAR(manoeuvre_angle(law, duration_s, (k + 1) * dt), sum, 1e-7 * duration_s);
            }
            EXPECT_EQ(manoeuvre_angle(law, duration_s, -1.0), 0.0);
        }
    }
}

double rms(const std::vector<SwitchError>& errors) {
    double sum = 0.0;
    for (const SwitchError& e : errors) sum += e.error_arcsec * e.error_arcsec;
    return std::sqrt(sum / static_cast<double>(errors.size()));
}

// A step of the rate far before or far after leaves no error but that of a gap at rest; a line through a gap in which
// the rate changes evenly is right, a constant is not.
TEST(Manoeuvres, APolynomialErrsAsItsOrderSays) {
    ManoeuvreTrial trial{.gyro = {.miss_lambda = 0.0}, .motion = {}, .manoeuvres = {}, .gaps = 60, .learn_ticks = 300};
    trial.manoeuvres = {
        {.rate_arcsec_s = 0.0},
        {.law = ManoeuvreLaw::linear, .place = ManoeuvrePlace::before, .rate_arcsec_s = 36000.0, .duration_s = 1.0}};
    const auto errors =
        run_manoeuvres(trial, methods_for(config_of(trial.gyro), {method_name::quadratic, method_name::automatic}));
    ASSERT_EQ(errors.size(), 2u);
    ASSERT_EQ(errors[0].size(), 2u);
    ASSERT_EQ(errors[1][1].size(), 60u);
    // Roundings alone: two readings at the edges of the gap, and the points, by weights 5/2 and -1.
    EXPECT_LT(rms(errors[0][0]), 3.0 * trial.gyro.scale_arcsec);
    EXPECT_GT(rms(errors[0][0]), 0.3 * trial.gyro.scale_arcsec);
    EXPECT_GT(rms(errors[1][0]), 0.5 * rms(errors[0][0]));
    for (const auto& of_manoeuvre : errors)
        for (const SwitchError& e : of_manoeuvre[1]) EXPECT_TRUE(std::isfinite(e.sigma_arcsec) && e.sigma_arcsec > 0.0);
}

// The first manoeuvre at a gap, in small: what the campaign demands of each place of an onset, and two standard errors
// of a hundred. The families, and what they miss, are in accuracy_test.cpp.
TEST(Manoeuvres, EveryGapHasASigmaThatKnowsOfTheFirstOne) {
    const std::vector<ManoeuvreFigures> figures = measure_manoeuvres(100, true, 5, 2);
    ASSERT_FALSE(figures.empty());
    for (const ManoeuvreFigures& f : figures) {
        const ErrorFigures& ours = find_method(f.methods, method_name::automatic)->whole;
        EXPECT_EQ(ours.claimed, ours.n);
        EXPECT_LT(ours.nev, f.manoeuvre.empty() ? 1.4 * 1.28 : 15.0 * 1.28) << f.base << ": " << f.manoeuvre;
    }
}

}  // namespace zlg::trials::manoeuvres_test
