#include <zlg/core/control/ellipse_correction.hpp>

#include "support.hpp"

namespace zlg::core::ellipse_correction_test {

constexpr double tau = 2.0 * std::numbers::pi;

// (1), written out.
struct Photodiodes {
    double c0 = 0.06, s0 = -0.08, a = 1.1, b = 0.93, angle_rad = 5.0 * tau / 360.0, noise = 0.0;
    std::mt19937_64 engine{7};
    std::normal_distribution<double> normal{};

    QuadratureSample at(double turns) {
        return {c0 + a * std::cos(tau * turns) + noise * normal(engine),
                s0 + b * std::sin(tau * turns + angle_rad) + noise * normal(engine)};
    }
};

double turns(const QuadratureSample& p) { return std::atan2(p.s, p.c) / tau; }

double apart(double a, double b) { return std::remainder(a - b, 1.0); }

constexpr double step_turns = 0.6180339887498949;  // never repeats

void learn_many(EllipseCorrectionState& state, Photodiodes& diodes, int n) {
    for (int k = 0; k < n; ++k) (void)learn(state, diodes.at(k * step_turns), k % 2 == 0 ? 1 : -1);
}

TEST(EllipseCorrection, AnEllipseIsLearntExactlyFromSamplesWithoutNoise) {
    Photodiodes diodes;
    EllipseCorrectionState state;
    learn_many(state, diodes, 400);
    ASSERT_TRUE(state.learnt);
    for (double x = 0.0; x < 1.0; x += 0.01) {
        const QuadratureSample p = on_circle(state.map, diodes.at(x));
        EXPECT_NEAR(std::hypot(p.c, p.s), 1.0, 1e-9);
        EXPECT_NEAR(apart(turns(p), x), 0.0, 1e-9) << x;
    }
    EXPECT_LT(state.noise_turns, 1e-6);
}

// Uncorrected these errors are worth 0.01 turns and more.
TEST(EllipseCorrection, WithNoiseThePhaseHasThatOfTheSamplesAlone) {
    Photodiodes diodes{.noise = 0.01};
    EllipseCorrectionState state;
    learn_many(state, diodes, 3000);
    ASSERT_TRUE(state.learnt);
    double sum = 0.0;
    double raw = 0.0;
    constexpr int n = 4000;
    for (int k = 0; k < n; ++k) {
        const double x = k * step_turns;
        const QuadratureSample sample = diodes.at(x);
        const double off = apart(turns(on_circle(state.map, sample)), x);
        sum += off * off;
        raw += apart(turns(sample), x) * apart(turns(sample), x);
    }
    const double expected = 0.01 / tau;
    EXPECT_NEAR(std::sqrt(sum / n), expected, 0.1 * expected);
    EXPECT_GT(std::sqrt(raw / n), 5.0 * expected);
    EXPECT_NEAR(state.noise_turns, expected, 0.2 * expected);
}

TEST(EllipseCorrection, AtRestNothingIsLearnt) {
    Photodiodes diodes{.noise = 0.01};
    EllipseCorrectionState state;
    for (int k = 0; k < 100'000; ++k) {
        EXPECT_FALSE(learn(state, diodes.at(k % 2 == 0 ? 0.11 : 0.57), k % 2 == 0 ? 1 : -1).completes);
    }
    EXPECT_FALSE(state.learnt);
}

TEST(EllipseCorrection, AnEllipseThatDriftsIsFollowed) {
    Photodiodes diodes;
    EllipseCorrectionState state;
    for (int k = 0; k < 40'000; ++k) {
        diodes.c0 = 0.1 * k / 40'000;
        (void)learn(state, diodes.at(k * step_turns), k % 2 == 0 ? 1 : -1);
    }
    const QuadratureSample p = on_circle(state.map, diodes.at(0.2));
    EXPECT_NEAR(apart(turns(p), 0.2), 0.0, 1e-3);
}

TEST(EllipseCorrection, ALineIsNoEllipse) {
    Photodiodes diodes{.s0 = 0.0, .b = 0.0, .noise = 0.01};
    EllipseCorrectionState state;
    learn_many(state, diodes, 20'000);
    EXPECT_FALSE(state.learnt);
}

}  // namespace zlg::core::ellipse_correction_test
