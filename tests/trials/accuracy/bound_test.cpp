#include "accuracy/bound.hpp"

#include "synthetic/relock_decay.hpp"
#include "test.hpp"

namespace zlg::trials::bound_test {

GyroLaw counted(double scale) {
    GyroLaw g;
    g.bias_hz *= g.scale_arcsec / scale;
    g.scale_arcsec = scale;
    return g;
}

MotionLaw tone(double frequency_hz) {
    MotionLaw m;
    m.tones = {{frequency_hz, 12000.0}};
    return m;
}

MotionLaw band(double high_hz) {
    MotionLaw m;
    m.bands = {{0.0, high_hz, 8485.28}};
    return m;
}

struct Expected {
    const char* name;
    MotionLaw motion;
    double ticks_x1, halves_x1, ticks_x4, halves_x4;
};

// From an independent computation by other authors, to its printed digits; 0 where it gives none.
TEST(AccuracyBound, IsThatOfAnIndependentComputation) {
    const Expected expected[] = {
        {"20 Hz", tone(20.0), 1.88, 1.55, 0.49, 0.40},
        {"18.3 Hz", tone(18.3), 0.0, 2.29, 0.0, 0.63},
        {"flat to 0.12/T", band(24.0), 0.0, 4.47, 0.0, 1.98},
        {"flat to 20 Hz", band(20.0), 0.0, 3.8, 0.0, 1.6},
    };
    for (const Expected& e : expected) {
        const SwitchBound x1 = bound_of(counted(3.263), e.motion);
        const SwitchBound x4 = bound_of(counted(0.81575), e.motion);
        const auto near = [&](double got, double wanted) {
            if (wanted > 0.0) EXPECT_NEAR(got / wanted, 1.0, 0.015) << e.name;
        };
        near(x1.ticks_arcsec, e.ticks_x1);
        near(x1.halves_arcsec, e.halves_x1);
        near(x4.ticks_arcsec, e.ticks_x4);
        near(x4.halves_arcsec, e.halves_x4);
    }
}

TEST(AccuracyBound, OfTheLightIsTheCramerRaoBoundOfASpline) {
    const auto of = [](LoopShape loop) {
        GyroLaw g;
        g.loop = loop;
        return bound_of(g, tone(20.0)).relock_arcsec;
    };
    EXPECT_NEAR(of(LoopShape::exponential), 0.73, 0.006);
    EXPECT_NEAR(of(LoopShape::slew), 0.72, 0.006);
    EXPECT_NEAR(of(LoopShape::second_order), 0.75, 0.01);
}

TEST(AccuracyBound, MoreKnowledgeIsNeverWorse) {
    for (const MotionLaw& motion : {tone(7.03), tone(20.06), band(20.0)}) {
        const SwitchBound b = bound_of(counted(3.263), motion);
        EXPECT_LE(b.halves_arcsec, b.ticks_arcsec);
    }
}

// By exact light, two lit halves at the end of a gap of three ticks are known as those after a gap of two; the
// bound observes one tick more then.
TEST(AccuracyBound, OfLitHalvesIsThatOfTheDarkOnes) {
    MotionLaw vibration;
    vibration.bands = {{5.0, 80.0, 8000.0}};
    for (const double scale : {3.263, 0.81575}) {
        GyroLaw lit = counted(scale);
        lit.light_noise_lambda = 1e-7;
        GyroLaw shorter = lit;
        lit.gap_ticks = 3;
        lit.lit_halves = 2;
        shorter.gap_ticks = 2;
        const double ratio = bound_of(lit, vibration).halves_arcsec / bound_of(shorter, vibration).halves_arcsec;
        EXPECT_LE(ratio, 1.0);
        EXPECT_GT(ratio, 0.95);
        EXPECT_GT(bound_of(lit, vibration).ticks_arcsec, 1.5 * bound_of(lit, vibration).halves_arcsec);
    }
}

// dl and the bound of its square are proportional: twice the miss doubles the slope of the square.
TEST(AccuracyBound, OfTheLightGrowsWithTheMiss) {
    GyroLaw g;
    const double one = bound_of(g, {}).relock_arcsec;
    g.miss_lambda *= 2.0;
    EXPECT_NEAR(bound_of(g, {}).relock_arcsec, 2.0 * one, 1e-9);
    g.light_samples = 64;
    EXPECT_NEAR(bound_of(g, {}).relock_arcsec, one, 0.05 * one);
}

}  // namespace zlg::trials::bound_test
