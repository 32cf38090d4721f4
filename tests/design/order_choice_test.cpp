#include <zlg/design/order_choice.hpp>

#include <rapidcheck/gtest.h>

#include <zlg/design/error.hpp>

#include "substitution_support.hpp"

namespace {

using namespace zlg::design;
using namespace substitution_test;

constexpr OrderQuestion papers{};

OrderQuestion up_to_four() {
    OrderQuestion q;
    q.substitution.points = {8, 4, 4};
    q.highest_order = 4;
    return q;
}

// At one point of the map: the ratio of amplitude to noise is A T/sigma.
int best_order(const OrderQuestion& question, const Tone& tone, double sigma_arcsec) {
    const double ratio = tone.amplitude_arcsec_s * question.substitution.tick_s / sigma_arcsec;
    return order_map(question, {tone.frequency_hz}, {ratio}).at(0).at(0);
}

// rms over phases of the error of simulated ticks, with the noise of the exact weights.
double simulated_rms(Substitution s, int order, double amplitude, double f, double sigma) {
    s.order = order;
    double square = 0.0;
    for (int k = 0; k < 16; ++k) {
        const double e = simulated_error(s, 1, s.n, amplitude, f, 2.0 * std::numbers::pi * k / 16);
        square += e * e / 16;
    }
    for (const Rational& w : exact_weights(s, 1, s.n)) square += std::pow(w.convert_to<double>() * sigma, 2);
    return std::sqrt(square);
}

// The paper's rows: amplitude 12 000 arcsec/s at 20 Hz, three ticks.
TEST(OrderChoice, RmsErrorsOfAToneOfRandomPhase) {
    const Tone tone{12000.0, 20.0};
    const auto rms = [&](Substitution s, int order, double sigma) {
        s.order = order;
        return std::hypot(rms_arcsec(ErrorResponse(s), tone), sum_gain(s, TickNoise::white) * sigma);
    };
    EXPECT_NEAR(rms({}, 0, 1.6), 109, 0.5);
    EXPECT_NEAR(rms({}, 0, 0.53), 109, 0.5);
    EXPECT_NEAR(rms({}, 2, 1.6), 19.9, 0.05);
    EXPECT_NEAR(rms({}, 2, 0.53), 19.1, 0.05);
    EXPECT_EQ(best_order(papers, tone, 1.6), 2);
    OrderQuestion quartic;
    quartic.substitution.points = {4, 3, 3};
    quartic.highest_order = 4;
    EXPECT_NEAR(rms(quartic.substitution, 4, 1.6), 9.6, 0.05);
    EXPECT_NEAR(rms(quartic.substitution, 4, 0.53), 4.8, 0.05);
    EXPECT_EQ(best_order(quartic, tone, 1.6), 4);
}

RC_GTEST_PROP(OrderChoiceLaw, TheChoiceIsTheLeastRmsOfSimulatedTicks, ()) {
    const OrderQuestion q = up_to_four();
    const double f = real_between(0.5, 60.0);
    const double amplitude = std::pow(10.0, real_between(0.0, 5.0));
    const double sigma = real_between(0.01, 3.0);
    const int choice = best_order(q, {amplitude, f}, sigma);
    const auto rms = [&](int order) { return simulated_rms(q.substitution, order, amplitude, f, sigma); };
    for (int order = 0; order <= 4; ++order) RC_ASSERT(rms(choice) <= rms(order) * (1.0 + 1e-8));
    RC_ASSERT(choice % 2 == 0);  // symmetric points: the lower of two equals
}

TEST(OrderChoice, NoMotionAsksForTheConstantAndNoNoiseForTheHighestOrderAtLowFrequency) {
    EXPECT_EQ(best_order(up_to_four(), {1e-9, 20.0}, 1.0), 0);
    EXPECT_EQ(best_order(up_to_four(), {1e4, 0.0}, 1.0), 0);
    EXPECT_EQ(best_order(up_to_four(), {1e4, 0.0}, 1e-15), 0);
    EXPECT_EQ(best_order(up_to_four(), {1e4, 2.0}, 1e-15), 4);
    EXPECT_EQ(best_order(papers, {1e4, 2.0}, 1e-15), 2);
}

TEST(OrderChoice, RoundingNeverDecidesBetweenEqualOrders) {
    for (int n = 1; n <= 30; ++n) {
        for (int side = 2; side <= 8; ++side) {
            OrderQuestion q;
            q.substitution = {Fit::interpolation, 0, n, {4, side, side}};
            q.highest_order = 4;
            EXPECT_EQ(best_order(q, {1e4, 0.0}, 1e-15), 0);
            for (const double f : {0.5, 3.0, 11.0}) EXPECT_EQ(best_order(q, {1e4, f}, 0.5) % 2, 0);
        }
    }
}

TEST(OrderChoice, FewPointsAllowLowOrdersOnly) {
    OrderQuestion q;
    q.substitution.points = {4, 1, 1};
    q.highest_order = 4;
    EXPECT_EQ(best_order(q, {1e4, 2.0}, 1e-15), 0);  // the line through two symmetric points has the sum of their mean
    q.substitution.points = {4, 2, 1};
    EXPECT_EQ(best_order(q, {1e4, 2.0}, 1e-15), 2);
}

TEST(OrderChoice, TheOrdersChangePlacesAtTheCrossing) {
    for (const double f : {1.0, 5.0, 10.0, 20.0}) {
        const auto ratio = crossing_ratio(papers, 0, 2, f);
        ASSERT_TRUE(ratio.has_value());
        const double sigma = 1.6;
        const auto rms = [&](int order, double factor) {
            return simulated_rms({}, order, factor * *ratio * sigma / 0.005, f, sigma);
        };
        EXPECT_NEAR(rms(0, 1.0), rms(2, 1.0), 1e-9 * rms(0, 1.0));
        EXPECT_EQ(best_order(papers, {0.999 * *ratio * sigma / 0.005, f}, sigma), 0);
        EXPECT_EQ(best_order(papers, {1.001 * *ratio * sigma / 0.005, f}, sigma), 2);
    }
    EXPECT_FALSE(crossing_ratio(papers, 0, 1, 20.0).has_value());  // the same estimator
    EXPECT_FALSE(crossing_ratio(papers, 2, 0, 20.0).has_value());
}

// Extrapolated over three ticks at 20 Hz the line is worse than the constant in motion, 312 to 259, and in noise.
TEST(OrderChoice, AnOrderThatIsBetterInBothWinsFromTheStart) {
    OrderQuestion q;
    q.substitution.fit = Fit::extrapolation;
    const auto ratio = crossing_ratio(q, 1, 0, 20.0);
    ASSERT_TRUE(ratio.has_value());
    EXPECT_EQ(*ratio, 0.0);
}

TEST(OrderChoice, TheMapIsTheChoiceAtEachPointAndRisesWithAmplitude) {
    const std::vector<double> frequencies{1, 5, 10, 15, 20};
    const std::vector<double> ratios{1, 10, 100, 1000, 10000};
    const auto map = order_map(up_to_four(), frequencies, ratios);
    ASSERT_EQ(map.size(), frequencies.size());
    for (std::size_t i = 0; i < map.size(); ++i) {
        for (std::size_t k = 0; k < ratios.size(); ++k) {
            EXPECT_EQ(map[i][k], best_order(up_to_four(), {ratios[k] * 0.8 / 0.005, frequencies[i]}, 0.8));
            if (k > 0) EXPECT_GE(map[i][k], map[i][k - 1]);
        }
    }
    EXPECT_EQ(map[0][0], 0);
    EXPECT_EQ(map[4][4], 4);
}

TEST(OrderChoice, RefusesWhatIsOutOfRange) {
    OrderQuestion q;
    q.highest_order = 5;
    EXPECT_THROW((void)order_map(q, {1.0}, {1.0}), DesignError);
    EXPECT_THROW((void)order_map(papers, {std::nan("")}, {1.0}), DesignError);
    EXPECT_THROW((void)order_map(papers, {1.0}, {std::nan("")}), DesignError);
    EXPECT_THROW((void)order_map(papers, {1.0}, {0.0}), DesignError);
    EXPECT_THROW((void)crossing_ratio(papers, 0, 4, 1.0), DesignError);
}

}  // namespace
