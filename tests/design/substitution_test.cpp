#include <zlg/design/substitution.hpp>

#include <rapidcheck/gtest.h>

#include <zlg/design/error.hpp>

#include "substitution_support.hpp"

namespace zlg::design::substitution_test {

using std::numbers::pi;

constexpr double amplitude = 12000.0;
constexpr double frequency = 20.0;

void expect_weights(const std::vector<double>& got, std::initializer_list<double> numerator, double denominator) {
    ASSERT_EQ(got.size(), numerator.size());
    std::size_t k = 0;
    for (const double w : numerator) EXPECT_NEAR(got[k++], w / denominator, 1e-14);
}

TEST(Substitution, WeightsOfThePaperAreItsExactFractions) {
    const Substitution e0{Fit::extrapolation, 0, 3}, e1{Fit::extrapolation, 1, 3}, e2{Fit::extrapolation, 2, 3};
    expect_weights(sum_weights(e0), {3, 3, 3, 3}, 4);
    expect_weights(sum_weights(e1), {-24, -3, 18, 39}, 10);
    expect_weights(sum_weights(e2), {127, -181, -139, 253}, 20);

    const Substitution i0{Fit::interpolation, 0, 3}, i1{Fit::interpolation, 1, 3}, i2{Fit::interpolation, 2, 3};
    expect_weights(sum_weights(i0), {3, 3, 3, 3}, 4);
    expect_weights(sum_weights(i1), {3, 3, 3, 3}, 4);
    expect_weights(sum_weights(i2), {-2, 5, 5, -2}, 2);
}

// The paper's four points and a gap of any length.
TEST(Substitution, SumWeightsOfTwoAndTwoPointsFollowTheirLawInN) {
    for (int n = 1; n <= 64; ++n) {
        const double outer = -n * (n + 1.0) / 12.0;
        const double inner = 0.5 * n - outer;
        for (int order : {0, 1})
            expect_weights(sum_weights({Fit::interpolation, order, n}), {n / 4., n / 4., n / 4., n / 4.}, 1);
        for (int order : {2, 3}) {
            const auto w = sum_weights({Fit::interpolation, order, n});
            for (std::size_t k : {0u, 3u}) EXPECT_NEAR(w[k], outer, 1e-12 * inner) << n;
            for (std::size_t k : {1u, 2u}) EXPECT_NEAR(w[k], inner, 1e-12 * inner) << n;
        }
    }
}

RC_GTEST_PROP(SubstitutionLaw, WeightsAreTheExactLeastSquaresTo1em12, ()) {
    const Substitution s = any_substitution(64, 20);
    RC_ASSERT(positions(s) == points_of(s));
    const auto got = sum_weights(s);
    const auto exact = exact_weights(s, 1, s.n);
    double largest = 0.0;
    for (const auto& w : exact) largest = std::max(largest, std::abs(w.convert_to<double>()));
    for (std::size_t k = 0; k < got.size(); ++k) {
        RC_ASSERT(std::abs(got[k] - exact[k].convert_to<double>()) <= 1e-12 * largest);
    }
}

TEST(Substitution, WeightsHoldWithTheMostPointsAndTicks) {
    const Substitution s{Fit::interpolation, 4, 64, {4, 64, 64}};
    const auto got = sum_weights(s);
    const auto exact = exact_weights(s, 1, 64);
    for (std::size_t k = 0; k < got.size(); ++k) EXPECT_NEAR(got[k], exact[k].convert_to<double>(), 1e-12);
}

RC_GTEST_PROP(SubstitutionLaw, APolynomialOfTheOrderIsSubstitutedExactly, ()) {
    const Substitution s = any_substitution(20, 12);
    const auto x = positions(s);
    const auto w = sum_weights(s);
    for (int degree = 0; degree <= s.order; ++degree) {
        double fitted = 0.0, truth = 0.0, scale = 0.0;
        for (std::size_t k = 0; k < x.size(); ++k) {
            fitted += w[k] * std::pow(x[k], degree);
            scale += std::abs(w[k] * std::pow(x[k], degree));
        }
        for (int j = 1; j <= s.n; ++j) truth += std::pow(j, degree);
        RC_ASSERT(std::abs(fitted - truth) <= 1e-13 * (scale + truth));
    }
}

RC_GTEST_PROP(SubstitutionLaw, EvenOrderAndTheNextOddGiveTheSameSumWithSymmetricPoints, ()) {
    const int side = integer_between(2, 19);
    const int even = *rc::gen::element(0, 2);
    const int n = integer_between(1, 64);
    RC_PRE(2 * side > even + 1);
    const auto a = sum_weights({Fit::interpolation, even, n, {4, side, side}});
    const auto b = sum_weights({Fit::interpolation, even + 1, n, {4, side, side}});
    for (std::size_t k = 0; k < a.size(); ++k) RC_ASSERT(std::abs(a[k] - b[k]) <= 1e-13 * std::abs(a[0]) + 1e-13);
}

RC_GTEST_PROP(SubstitutionLaw, TimeReversalExchangesTheSides, ()) {
    Substitution s = any_substitution(64, 20);
    s.fit = Fit::interpolation;
    Substitution r = s;
    std::swap(r.points.before, r.points.after);
    auto mirrored = sum_weights(r);
    std::reverse(mirrored.begin(), mirrored.end());
    const auto w = sum_weights(s);
    double largest = 0.0;
    for (const double v : w) largest = std::max(largest, std::abs(v));
    for (std::size_t k = 0; k < w.size(); ++k) RC_ASSERT(std::abs(w[k] - mirrored[k]) <= 1e-12 * largest);
    const double f = real_between(0.0, 200.0);
    const auto reversed = std::conj(ErrorResponse(r)(f));
    RC_ASSERT(std::abs(ErrorResponse(s)(f) - reversed) <= 1e-12 * (1.0 + largest * s.n) * s.tick_s * s.n);
}

RC_GTEST_PROP(SubstitutionLaw, TheResponseDependsOnFrequencyTimesTickOnly, ()) {
    Substitution s = any_substitution(10, 8);
    const double f = real_between(0.0, 100.0);
    const auto h = ErrorResponse(s)(f);
    s.tick_s *= 2.0;
    RC_ASSERT(std::abs(ErrorResponse(s)(0.5 * f) - 2.0 * h) <= 1e-14 * (1.0 + std::abs(h)));
}

// Small weights, so that 1e-9 arcsec is above rounding: amplitude of a tick 60 arcsec.
RC_GTEST_PROP(SubstitutionLaw, TheErrorIsThatOfTheTicksThemselves, ()) {
    Substitution s = any_substitution(5, 6);
    const bool tame = s.fit == Fit::extrapolation ? s.order < 3 : s.points.before > 0 && s.points.after > 0;
    RC_PRE(tame);
    const double f = real_between(0.1, 150.0);
    const double phase = real_between(-pi, pi);
    const auto error = [&](const ErrorResponse& h) { return amplitude * std::imag(h(f) * std::polar(1.0, phase)); };
    double size = 1.0;
    for (const double w : sum_weights(s)) size = std::max(size, std::abs(w));
    RC_ASSERT(std::abs(error(ErrorResponse(s)) - simulated_error(s, 1, s.n, amplitude, f, phase)) <= 1e-10 * size);
}

TEST(Substitution, ErrorsOfThePapersOscillationAtTheWorstPhase) {
    const double constant[] = {26.03, 77.57, 154.51}, quadratic[] = {1.44, 8.19, 26.85};
    const double before[3][3] = {{74, 50, 23}, {165, 153, 98}, {259, 312, 260}};
    const Tone tone{amplitude, frequency};
    for (int n = 1; n <= 3; ++n) {
        const auto error = [&](Fit fit, int order) { return worst(ErrorResponse({fit, order, n}), tone).error_arcsec; };
        const auto i = static_cast<std::size_t>(n - 1);
        EXPECT_NEAR(error(Fit::interpolation, 0), constant[i], 0.0051);
        EXPECT_NEAR(error(Fit::interpolation, 1), constant[i], 0.0051);
        EXPECT_NEAR(error(Fit::interpolation, 2), quadratic[i], 0.0051);
        for (int order = 0; order < 3; ++order) EXPECT_NEAR(error(Fit::extrapolation, order), before[i][order], 0.5);
    }
}

TEST(Substitution, WorstPhaseIsTheMaximumOverAllPhasesAndRmsTheirMeanSquare) {
    for (const Fit fit : {Fit::extrapolation, Fit::interpolation}) {
        const Substitution s{fit, 2, 3, {4, 2, 1}};
        const auto response = ErrorResponse(s);
        const auto answer = worst(response, {amplitude, frequency});
        double largest = 0.0, square = 0.0;
        constexpr int n_phases = 3600;
        for (int k = 0; k < n_phases; ++k) {
            const double e = simulated_error(s, 1, s.n, amplitude, frequency, 2.0 * pi * k / n_phases);
            largest = std::max(largest, e);
            square += e * e / n_phases;
        }
        EXPECT_NEAR(answer.error_arcsec, largest, 1e-6 * largest);
        EXPECT_NEAR(simulated_error(s, 1, s.n, amplitude, frequency, answer.phase_rad), answer.error_arcsec, 1e-9);
        EXPECT_NEAR(rms_arcsec(response, Tone{amplitude, frequency}), std::sqrt(square), 1e-9);
    }
}

TEST(Substitution, AGapCentredOnAZeroCrossingHasNoErrorAndOneOnAnExtremumTheWorst) {
    for (int order = 0; order <= 4; ++order) {
        const Substitution s{Fit::interpolation, order, 3, {4, 3, 3}};
        EXPECT_NEAR(simulated_error(s, 1, 3, amplitude, frequency, 0.0), 0.0, 1e-10);
        EXPECT_NEAR(ErrorResponse(s)(frequency).imag(), 0.0, 1e-16);
        EXPECT_NEAR(std::abs(worst(ErrorResponse(s), {amplitude, frequency}).phase_rad), 0.5 * pi, 1e-9);
    }
}

TEST(Substitution, ASumOfTonesAddsWorstErrorsAndPowers) {
    const auto response = ErrorResponse({});
    const std::array<Tone, 3> tones{Tone{100.0, 5.0}, Tone{-40.0, 17.0}, Tone{7.0, 33.0}};
    double sum = 0.0, square = 0.0;
    for (const Tone& t : tones) {
        const double e = std::abs(t.amplitude_arcsec_s) * std::abs(response(t.frequency_hz));
        sum += e;
        square += 0.5 * e * e;
    }
    EXPECT_NEAR(worst_bound_arcsec(response, tones), sum, 1e-12 * sum);
    EXPECT_NEAR(rms_arcsec(response, tones), std::sqrt(square), 1e-12 * sum);
    EXPECT_EQ(rms_arcsec(response, std::span<const Tone>{}), 0.0);
}

TEST(Substitution, RefusesWhatHasNoAnswer) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW((void)sum_weights({Fit::interpolation, 4, 3}), DesignError);
    EXPECT_THROW((void)sum_weights({Fit::extrapolation, 4, 3}), DesignError);
    EXPECT_THROW((void)sum_weights({Fit::interpolation, -1, 3}), DesignError);
    EXPECT_THROW((void)sum_weights({Fit::interpolation, 5, 3, {8, 8, 8}}), DesignError);
    EXPECT_THROW((void)sum_weights({Fit::interpolation, 0, 0}), DesignError);
    EXPECT_THROW((void)sum_weights({Fit::interpolation, 0, 65}), DesignError);
    EXPECT_THROW((void)sum_weights({Fit::interpolation, 0, 3, {4, -1, 4}}), DesignError);
    EXPECT_THROW((void)sum_weights({Fit::interpolation, 0, 3, {4, 65, 4}}), DesignError);
    EXPECT_THROW((void)ErrorResponse({Fit::interpolation, 2, 3, {}, nan}), DesignError);
    const auto response = ErrorResponse({});
    EXPECT_THROW((void)response(nan), DesignError);
    EXPECT_THROW((void)worst(response, {nan, 1.0}), DesignError);
}

}  // namespace zlg::design::substitution_test
