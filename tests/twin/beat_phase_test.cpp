#include <zlg/twin/beat_phase.hpp>

#include <zlg/core/common/maths.hpp>

#include "adler_reference.hpp"
#include "turns_from.hpp"

namespace zlg::twin::beat_phase_test {

using core::not_a_number;
using std::numbers::pi;
constexpr double infinity = std::numeric_limits<double>::infinity();

double as_number(const Turns& t) { return t.minus(Turns{}); }

class Draw {
public:
    explicit Draw(std::uint64_t seed) : engine_{seed} {}
    double uniform(double from, double to) { return std::uniform_real_distribution<double>{from, to}(engine_); }
    double spread(double from, double to) { return std::exp(uniform(std::log(from), std::log(to))); }
    bool coin() { return uniform(0.0, 1.0) < 0.5; }

private:
    std::mt19937_64 engine_;
};

// A reversal anywhere in the range of the gyros: bias, edge, lock-in, rate up to +-400 deg/s in every second one.
AdlerRamp random_reversal(Draw& draw) {
    const double bias = draw.uniform(20e3, 200e3) * (draw.coin() ? 1.0 : -1.0);
    const double rate = draw.coin() ? draw.uniform(-441e3, 441e3) : 0.0;
    const Coupling c = std::polar(draw.spread(50.0, 1000.0), draw.uniform(0.0, 2.0 * pi));
    return {rate - bias, rate + bias, c, draw.uniform(10e-6, 200e-6)};
}

double error_rad(const AdlerRamp& r, double start, int pieces, double reference) {
    BeatPhase beat{turns(start)};
    beat.ramp_in_pieces(r.start_hz, r.end_hz, r.coupling, r.duration_s, pieces);
    return 2.0 * pi * std::abs(as_number(beat.value()) - reference);
}

TEST(Turns, AddWithoutLossWhateverTheyHaveGrownTo) {
    Turns t{std::int64_t{1} << 62, 0.25};
    const Turns before = t;
    for (int i = 0; i < 1000; ++i) t.add(i % 2 == 0 ? 147.125 : -146.875);
    EXPECT_EQ(t.whole - before.whole, 125);
    EXPECT_EQ(t.part, 0.25);
    EXPECT_EQ(t.minus(before), 125.0);
    EXPECT_EQ(before.minus(t), -125.0);
}

TEST(Turns, KeepTheirPartWithinATurn) {
    for (const double step : {-1e-20, 1e-20, -1.0, 1.0, -0.999999999999999, 0.5, -0.5}) {
        Turns t{0, 0.5};
        for (int i = 0; i < 5; ++i) {
            t.add(step);
            EXPECT_GE(t.part, 0.0);
            EXPECT_LT(t.part, 1.0);
        }
        EXPECT_NEAR(as_number(t), 0.5 + 5.0 * step, 1e-14);
    }
}

TEST(Backscatter, EqualMirrorsLockMoreWhereTheWavesAreUnequal) {
    const Backscatter b = Backscatter::equal(300.0, 0.7);
    EXPECT_NEAR(std::abs(b.coupling(1.0, 1.0)), 300.0, 1e-10);
    EXPECT_NEAR(std::arg(b.coupling(1.0, 1.0)), 0.7, 1e-14);
    for (const double ratio : {0.01, 0.3, 2.0, 50.0}) {
        EXPECT_NEAR(std::abs(b.coupling(ratio, 1.0)), 300.0 * (ratio + 1.0) / (2.0 * std::sqrt(ratio)), 1e-9);
    }
}

// The two terms of Aronowitz's equation: r1 sqrt(I1/I2) sin(psi - eps) + r2 sqrt(I2/I1) sin(psi + eps).
TEST(Backscatter, IsTheSumOfWhatBothMirrorsReturn) {
    const Backscatter b{40.0, 110.0, 0.6, 0.0};
    const double i1 = 0.8, i2 = 1.3;
    for (double psi = 0.0; psi < 6.3; psi += 0.7) {
        const double pull =
            40.0 * std::sqrt(i1 / i2) * std::sin(psi - 0.6) + 110.0 * std::sqrt(i2 / i1) * std::sin(psi + 0.6);
        EXPECT_NEAR((b.coupling(i1, i2) * std::polar(1.0, psi)).imag(), pull, 1e-11);
    }
}

TEST(BeatPhase, WithoutBackscatterIsTheIntegralOfTheDrive) {
    BeatPhase beat{turns(0.3)};
    beat.plateau(60e3, 0.0, 2.45e-3);
    EXPECT_NEAR(as_number(beat.value()), 0.3 + 147.0, 1e-12);
    beat.ramp(60e3, -60e3, 0.0, 50e-6);
    EXPECT_NEAR(as_number(beat.value()), 0.3 + 147.0, 1e-12);
    beat.ramp(0.0, -501e3, 0.0, 200e-6);
    EXPECT_NEAR(as_number(beat.value()), 0.3 + 147.0 - 50.1, 1e-11);
}

TEST(BeatPhase, BeatsAtTheRootOfTheDifferenceOfSquares) {
    const double lock = 300.0;
    for (const double drive : {300.1, 310.0, 600.0, -450.0, 60e3, -501e3}) {
        const double beat_hz = std::copysign(std::sqrt((drive - lock) * (drive + lock)), drive);
        for (const double n : {1.0, 7.0, 1000.0}) {
            BeatPhase beat{turns(0.37)};
            beat.plateau(drive, std::polar(lock, 1.1), n / std::abs(beat_hz));
            // A whole number of beats turns every phase by the same.
            EXPECT_NEAR(as_number(beat.value()), 0.37 + std::copysign(n, drive), 2e-9) << drive << " " << n;
        }
    }
}

TEST(BeatPhase, LocksWhereThePullHoldsTheDrive) {
    const double lock = 300.0;
    for (const double drive : {0.0, 100.0, -100.0, 290.0, -299.0}) {
        for (double start = 0.01; start < 1.0; start += 0.09) {
            BeatPhase beat{turns(start)};
            beat.plateau(drive, std::polar(lock, 0.4), 0.5);
            const double angle = std::remainder(beat.value().part_rad() + 0.4, 2.0 * pi);
            EXPECT_NEAR(angle, std::asin(drive / lock), 1e-6) << drive << " " << start;
            EXPECT_LT(std::abs(as_number(beat.value()) - start), 1.0);
        }
    }
}

// psi' = w (1 - sin psi): tan(psi/2 + pi/4) grows by w t.
TEST(BeatPhase, OnTheBorderOfLockInCreepsAlgebraically) {
    const double f = 200.0;
    for (double start = -0.7; start < 0.2; start += 0.1) {
        BeatPhase beat{turns(start)};
        beat.plateau(f, f, 1e-3);
        const double grown = std::tan(pi * start + 0.25 * pi) + 2.0 * pi * f * 1e-3;
        EXPECT_NEAR(as_number(beat.value()), (std::atan(grown) - 0.25 * pi) / pi, 1e-12) << start;
    }
}

TEST(BeatPhase, OnAPlateauAgreesWithAGeneralIntegrator) {
    Draw draw{11};
    for (int i = 0; i < 1000; ++i) {
        const Coupling c = std::polar(draw.spread(10.0, 3000.0), draw.uniform(0.0, 6.3));
        const double drive = std::abs(c) * draw.uniform(-3.0, 3.0);
        const double start = draw.uniform(0.0, 1.0);
        const double duration = draw.uniform(0.0, 2.0) / std::abs(c);
        BeatPhase beat{turns(start)};
        beat.plateau(drive, c, duration);
        EXPECT_NEAR(as_number(beat.value()), adler_reference({drive, drive, c, duration}, start), 1e-9)
            << drive << " " << c << " " << duration;
    }
}

// Ten thousand reversals at random: the order of the stepper, and what its own choice of pieces leaves.
TEST(BeatPhase, RampsConvergeWithTheFourthPowerOfThePiecesAndAreGoodToAHundredthOfAMilliradian) {
    Draw draw{12};
    double square[3] = {};
    double worst = 0.0;
    int exceptions = 0;
    for (int i = 0; i < 10000; ++i) {
        const AdlerRamp r = random_reversal(draw);
        const double start = draw.uniform(0.0, 1.0);
        const int n = static_cast<int>(ramp_pieces(r.start_hz, r.end_hz, std::abs(r.coupling), r.duration_s));
        const double reference = adler_reference(r, start);
        double error[3];
        for (int k = 0; k < 3; ++k) {
            error[k] = error_rad(r, start, n << k, reference);
            square[k] += error[k] * error[k];
        }
        // Below 1e-9 rad the reference itself is uncertain.
        if (error[1] > error[0] / 8.0 + 1e-9 || error[2] > error[1] / 10.0 + 1e-9) ++exceptions;
        BeatPhase beat{turns(start)};
        beat.ramp(r.start_hz, r.end_hz, r.coupling, r.duration_s);
        worst = std::max(worst, 2.0 * pi * std::abs(as_number(beat.value()) - reference));
    }
    EXPECT_NEAR(std::sqrt(square[0] / square[1]), 16.0, 1.0);
    EXPECT_NEAR(std::sqrt(square[1] / square[2]), 16.0, 1.0);
    // Where two contributions cancel, a single error may fall more slowly.
    EXPECT_LT(exceptions, 100);
    EXPECT_LT(worst, 1e-5);
}

// Rotation that changes while one half of the bias is about cancelled by it: slow ramps through the locked region.
TEST(BeatPhase, SlowRampsThroughLockInAreGoodToAHundredthOfAMilliradian) {
    Draw draw{14};
    double worst = 0.0;
    for (int i = 0; i < 1000; ++i) {
        const Coupling c = std::polar(draw.spread(50.0, 5000.0), draw.uniform(0.0, 6.3));
        const AdlerRamp r{draw.uniform(-5e3, 5e3), draw.uniform(-5e3, 5e3), c, draw.spread(1e-5, 3e-3)};
        const double start = draw.uniform(0.0, 1.0);
        // Near an unstable point neighbours part by exp(w_L t), and errors with them.
        if (2.0 * pi * std::abs(c) * r.duration_s > 4.0) continue;
        BeatPhase beat{turns(start)};
        beat.ramp(r.start_hz, r.end_hz, r.coupling, r.duration_s);
        worst = std::max(worst, 2.0 * pi * std::abs(as_number(beat.value()) - adler_reference(r, start)));
    }
    EXPECT_LT(worst, 1e-5);
}

TEST(BeatPhase, TakesTheClosedFormOnlyWhereTheDriveHardlyChanges) {
    for (const double end : {60e3, 60e3 + 1e-3, 60e3 + 5.0, 60e3 + 100.0, 61e3, 300.0, -60e3}) {
        const AdlerRamp r{60e3, end, 300.0, 2.45e-3};
        for (double start = 0.0; start < 1.0; start += 0.19) {
            BeatPhase beat{turns(start)};
            beat.advance(r.start_hz, r.end_hz, r.coupling, r.duration_s);
            EXPECT_NEAR(2.0 * pi * as_number(beat.value()), 2.0 * pi * adler_reference(r, start), 1e-5) << end;
        }
    }
}

// A tick of two plateaus and two reversals, against a general integrator.
TEST(BeatPhase, WholeTicksAreGoodToATenthOfAMilliradian) {
    const Coupling c = std::polar(300.0, 0.7);
    BeatPhase beat{turns(0.2)};
    double reference = 0.2;
    for (int tick = 0; tick < 3; ++tick) {
        for (const double sign : {1.0, -1.0}) {
            const double drive = 1532.0 + sign * 60e3;
            const double next = 1532.0 - sign * 60e3;
            beat.advance(drive, drive, c, 2.45e-3);
            beat.advance(drive, next, c, 50e-6);
            reference = adler_reference({drive, drive, c, 2.45e-3}, reference);
            reference = adler_reference({drive, next, c, 50e-6}, reference);
        }
        EXPECT_NEAR(2.0 * pi * as_number(beat.value()), 2.0 * pi * reference, 2e-5);
    }
}

TEST(BeatPhase, IsTheSameHoweverManyTurnsWentBefore) {
    BeatPhase young{Turns{0, 0.375}};
    BeatPhase old{Turns{1'000'000'000'000, 0.375}};  // half a year of bias
    for (int i = 0; i < 1000; ++i) {
        for (BeatPhase* beat : {&young, &old}) {
            beat->plateau(61e3, 300.0, 2.45e-3);
            beat->ramp(61e3, -59e3, 300.0, 50e-6);
            beat->plateau(-59e3, 300.0, 2.45e-3);
            beat->ramp(-59e3, 61e3, 300.0, 50e-6);
        }
    }
    EXPECT_EQ(young.value().part, old.value().part);
    EXPECT_EQ(old.value().whole - young.value().whole, 1'000'000'000'000);
}

TEST(BeatPhase, RefusesDrivesThatCannotBeTold) {
    for (const double bad : {not_a_number, infinity, -infinity, 1e30}) {
        BeatPhase beat;
        EXPECT_THROW(beat.plateau(bad, 300.0, 1.0), std::overflow_error);
        EXPECT_THROW(beat.plateau(60e3, bad, 1.0), std::overflow_error);
        EXPECT_THROW(beat.ramp(0.0, bad, 300.0, 1.0), std::overflow_error);
        EXPECT_THROW(beat.ramp(60e3, 0.0, bad, 1.0), std::overflow_error);
        EXPECT_THROW(beat.advance(bad, bad, 300.0, 1.0), std::overflow_error);
    }
}

}  // namespace zlg::twin::beat_phase_test
