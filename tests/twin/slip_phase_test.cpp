#include "slip_phase.hpp"

#include "test.hpp"
#include "turns_from.hpp"

namespace zlg::twin::slip_phase_test {

using std::numbers::pi;

// psi of the exact stepper and the smoothed phase differ by (f_L/f) cos(psi + phi)/(2 pi) turns.
double ripple(double psi_turns, double drive_hz, Coupling c) {
    return (c * std::polar(1.0, 2.0 * pi * psi_turns)).real() / (2.0 * pi * drive_hz);
}

struct Worst {
    double after_rad = 0.0;
    double slip_rad = 0.0;
};

Worst against_exact(double start_hz, double end_hz, Coupling c, double duration_s) {
    Worst worst;
    for (double psi = 0.0; psi < 1.0; psi += 0.005) {
        BeatPhase exact{turns(psi)};
        exact.ramp_in_pieces(start_hz, end_hz, c, duration_s, 200);
        const double end = exact.value().minus(Turns{});
        const double smooth_start = psi - ripple(psi, start_hz, c);
        const double smooth_end = end - ripple(end, end_hz, c);

        SlipPhase slip{turns(smooth_start)};
        slip.reversal(start_hz, end_hz, c, duration_s);
        worst.after_rad = std::max(worst.after_rad, 2.0 * pi * std::abs(slip.value().minus(Turns{}) - smooth_end));
        const double free = 0.5 * (start_hz + end_hz) * duration_s;
        worst.slip_rad = std::max(worst.slip_rad, 2.0 * pi * std::abs(smooth_end - smooth_start - free));
    }
    return worst;
}

TEST(SlipPhase, ReversalsAgreeWithTheExactStepper) {
    for (const double sign : {1.0, -1.0}) {
        EXPECT_LT(against_exact(-60e3 * sign, 60e3 * sign, std::polar(150.0, 0.7), 50e-6).after_rad, 1.0e-4);
        EXPECT_LT(against_exact(-60e3 * sign, 60e3 * sign, std::polar(300.0, 0.7), 50e-6).after_rad, 2.0e-4);
        EXPECT_LT(against_exact(-54e3 * sign, 66e3 * sign, std::polar(300.0, 0.7), 50e-6).after_rad, 2.0e-4);
        EXPECT_LT(against_exact(-60e3 * sign, 60e3 * sign, std::polar(300.0, 0.7), 100e-6).after_rad, 1.0e-4);
    }
}

// The slip itself: omega_L sqrt(t_e/(2 f0)), 0.0385 rad, to the few per cent that the ends of the edge add.
TEST(SlipPhase, TheLargestSlipIsThatOfTheFormula) {
    const double formula = 2.0 * pi * 300.0 * std::sqrt(50e-6 / (2.0 * 60e3));
    EXPECT_NEAR(formula, 0.0385, 1e-4);
    EXPECT_NEAR(against_exact(-60e3, 60e3, 300.0, 50e-6).slip_rad / formula, 1.0, 0.03);
    // A long edge has no ends to speak of; the largest slip of the endless one is 2 asin b.
    const double depth = 2.0 * pi * 3000.0 * std::sqrt(2e-3 / (2.0 * 200e3));
    const double b = std::sqrt(1.0 - std::exp(-0.25 * depth * depth));
    EXPECT_NEAR(against_exact(-200e3, 200e3, 3000.0, 2e-3).slip_rad / (2.0 * std::asin(b)), 1.0, 0.01);
}

// Between unequal ends the beat is pulled more on the slower side: 1.9e-3 rad here.
TEST(SlipPhase, UnequalEndsLeaveTheMeanPullOfTheBeat) {
    EXPECT_LT(against_exact(-20e3, 100e3, 300.0, 500e-6).after_rad, 5e-4);
    EXPECT_LT(against_exact(-100e3, 20e3, 300.0, 500e-6).after_rad, 5e-4);
}

TEST(SlipPhase, ThePhaseAtTheMiddleIsThatOfTheCounter) {
    for (double psi = 0.0; psi < 1.0; psi += 0.05) {
        BeatPhase exact{turns(psi + ripple(psi, -60e3, 300.0))};
        exact.ramp(-60e3, 0.0, 300.0, 25e-6);
        SlipPhase slip{turns(psi)};
        const Turns middle = slip.reversal(-60e3, 60e3, 300.0, 50e-6);
        EXPECT_NEAR(2.0 * pi * middle.minus(exact.value()), 0.0, 2e-3);
    }
}

TEST(SlipPhase, APlateauRunsAtTheMeanOfTheBeat) {
    SlipPhase slip;
    slip.plateau(-60e3, 300.0, 1.0);
    EXPECT_NEAR(slip.value().minus(Turns{}), -std::sqrt(60e3 * 60e3 - 300.0 * 300.0), 1e-9);
}

TEST(SlipPhase, HandsOverToTheExactStepperWhereTheFormulaDoesNotHold) {
    EXPECT_TRUE(slip_formula_holds(-60e3, 60e3, 300.0, 50e-6));
    EXPECT_FALSE(slip_formula_holds(10e3, 130e3, 300.0, 50e-6));  // misses zero
    EXPECT_FALSE(slip_formula_holds(-1e3, 119e3, 300.0, 50e-6));  // one end near lock-in
    EXPECT_FALSE(slip_formula_holds(-60e3, 60e3, 300.0, 1e-6));   // over before the beat has turned
    EXPECT_LT(against_exact(61e3, 181e3, 300.0, 50e-6).after_rad, 1e-4);

    SlipPhase slip{turns(0.3)};
    BeatPhase exact{turns(0.3)};
    slip.plateau(100.0, 300.0, 1e-3);
    exact.plateau(100.0, 300.0, 1e-3);
    EXPECT_EQ(slip.value().minus(exact.value()), 0.0);
}

TEST(SlipPhase, RefusesWhatTheExactStepperRefuses) {
    for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), 1e30}) {
        SlipPhase slip;
        EXPECT_THROW(slip.plateau(bad, 300.0, 1.0), std::overflow_error);
        EXPECT_THROW(slip.reversal(-bad, bad, 300.0, 50e-6), std::overflow_error);
    }
}

}  // namespace zlg::twin::slip_phase_test
