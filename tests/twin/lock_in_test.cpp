// What backscatter makes of a gyro with alternating bias, and what the dither of the edges makes of that.

#include <zlg/core/compensation/lock_in.hpp>

#include "lock_in_gyro.hpp"

namespace zlg::twin::lock_in_test {

using std::numbers::pi;

// Slip of one reversal, rad.
double slip_rad(const LockInGyro& g) { return 2.0 * pi * g.lock_hz * std::sqrt(g.edge_s / (2.0 * g.bias_hz)); }

// Half-width of the dynamic zone at k K/T: K/(2 pi T) 2 d |cos pi (F + k/2 - 1/4)|, F = f0 (T - t_e)/2 cycles.
double zone_arcsec_s(const LockInGyro& g, int k) {
    const double cycles = 0.5 * g.bias_hz * (g.tick_s - g.edge_s);
    return g.scale_arcsec / (2.0 * pi * g.tick_s) * 2.0 * slip_rad(g) *
           std::abs(std::cos(pi * (cycles + 0.5 * k - 0.25)));
}

double zone_spacing_arcsec_s(const LockInGyro& g) { return g.scale_arcsec / g.tick_s; }

double settled_rate(LockInGyro g, double rate_arcsec_s, int n) {
    g.rate_arcsec_s = rate_arcsec_s;
    LockInRun run{g};
    run.mean_rate(2000);
    return run.mean_rate(n);
}

// Half-width of the zone around zero, by trial.
double found_zone(const LockInGyro& g) {
    double held = 0.0, free = 20.0;
    for (int i = 0; i < 12; ++i) {
        const double rate = 0.5 * (held + free);
        (std::abs(settled_rate(g, rate, 8000)) < 0.02 ? held : free) = rate;
    }
    return 0.5 * (held + free);
}

struct Walk {
    double mean_arcsec_s = 0.0;
    double arw_deg_sqrt_h = 0.0;
};

// Angle random walk from the scatter of stretches, by default of a tenth of a second.
Walk walk(const LockInGyro& g, int n_blocks, int ticks = 20) {
    LockInRun run{g};
    run.mean_rate(2000);
    double sum = 0.0, square = 0.0;
    for (int i = 0; i < n_blocks; ++i) {
        const double error = run.mean_rate(ticks) - g.rate_arcsec_s;
        sum += error;
        square += error * error;
    }
    const double mean = sum / n_blocks;
    const double variance = square / n_blocks - mean * mean;
    return {mean, std::sqrt(variance * ticks * g.tick_s) / 60.0};
}

TEST(LockIn, WithoutBackscatterTheRateIsExact) {
    for (const double rate : {0.0, 0.1, 15.0, -652.6, 1e5}) {
        EXPECT_NEAR(settled_rate({.lock_hz = 0.0}, rate, 2000), rate, 1e-7);
        EXPECT_NEAR(settled_rate({.lock_hz = 0.0, .dithered = true}, rate, 2000), rate, 1e-7);
    }
}

TEST(LockIn, TheDeadZoneHasTheWidthOfTheFormula) {
    for (const double bias : {60000.0, 60200.0, 60320.0}) {
        const LockInGyro g{.bias_hz = bias};
        const double formula = zone_arcsec_s(g, 0);
        ASSERT_GT(formula, 3.0);
        EXPECT_NEAR(found_zone(g) / formula, 1.0, 0.1) << bias;
    }
}

// An independent integration of the same equations found 5.90, 2.15 and 8.09 arcsec/s.
TEST(LockIn, TheDeadZoneIsThatOfAnIndependentSimulation) {
    EXPECT_NEAR(found_zone({.bias_hz = 60000.0}), 5.90, 0.1);
    EXPECT_NEAR(found_zone({.bias_hz = 60140.0}), 2.15, 0.2);
    EXPECT_NEAR(found_zone({.bias_hz = 60320.0}), 8.09, 0.1);
}

TEST(LockIn, OutsideTheDeadZoneTheRateIsTheRootOfTheDifferenceOfSquares) {
    const LockInGyro g{.bias_hz = 60320.0};
    const double zone = found_zone(g);
    for (const double ratio : {1.2, 2.0, 4.0}) {
        EXPECT_NEAR(settled_rate(g, ratio * zone, 20000) / (zone * std::sqrt(ratio * ratio - 1.0)), 1.0, 0.03) << ratio;
    }
}

TEST(LockIn, OddZonesAreWideWhereEvenOnesAreNarrow) {
    const LockInGyro g{.bias_hz = 60140.0};
    const double centre = zone_spacing_arcsec_s(g);
    const double wide = zone_arcsec_s(g, 1);
    ASSERT_GT(wide, 3.0 * zone_arcsec_s(g, 0));
    EXPECT_NEAR(settled_rate(g, centre + 0.8 * wide, 8000), centre, 0.02);
    EXPECT_NEAR(settled_rate(g, centre - 0.8 * wide, 8000), centre, 0.02);
    EXPECT_GT(settled_rate(g, centre + 1.2 * wide, 8000), centre + 1.0);
}

// The rate equals the bias: in one half of each period the beat stands still, so only half of a change is seen, and as
// each period begins at the same phase, it brings a whole number of counts.
TEST(LockIn, TheRateOfTheBiasLocksOneHalf) {
    const LockInGyro g{.edge_s = 10e-6, .lock_hz = 3000.0};
    const double bias = g.scale_arcsec * g.bias_hz;
    const double step = zone_spacing_arcsec_s(g);
    const double within = 0.8 * g.scale_arcsec * g.lock_hz;
    const double low = settled_rate(g, bias - within, 4000), high = settled_rate(g, bias + within, 4000);
    EXPECT_NEAR((high - low) / (2.0 * within), 0.5, step / (2.0 * within));
    EXPECT_NEAR(std::remainder(high - low, step), 0.0, 1e-6);
    const double beyond = 8.0 * g.scale_arcsec * g.lock_hz;
    const double all = settled_rate(g, bias + beyond, 4000) - settled_rate(g, bias - beyond, 4000);
    EXPECT_NEAR(all / (2.0 * beyond), 1.0, 0.02);
}

TEST(LockIn, RandomPhasesWalkAsTheSlipsAddUp) {
    for (const auto& [lock_hz, known] : {std::pair{150.0, 0.0024}, std::pair{300.0, 0.0047}}) {
        LockInGyro g{.lock_hz = lock_hz, .rate_arcsec_s = 5000.0, .dithered = true};
        const double arw = walk(g, 5000).arw_deg_sqrt_h;
        EXPECT_NEAR(arw / known, 1.0, 0.1);
        const double formula = g.scale_arcsec / (2.0 * pi) * slip_rad(g) / std::sqrt(g.tick_s) / 60.0;
        EXPECT_NEAR(arw / formula, 1.0, 0.05);
    }
}

//   +(1/2) (f_L/f0)^2 (1 - 4 t_e/T)/(1 - x^2),  x = rate/(K f0)
//
// of a gyro whose phases at the reversals are random: without dither, their fixed relation adds up to half as much.
double scale_error(const LockInGyro& g, int n) {
    LockInRun run{g};
    run.mean_rate(2000);
    return run.mean_rate(n) / g.rate_arcsec_s - 1.0;
}

double scale_error_formula(const LockInGyro& g) {
    const double x = g.rate_arcsec_s / (g.scale_arcsec * g.bias_hz);
    const double ratio = g.lock_hz / g.bias_hz;
    return 0.5 * ratio * ratio * (1.0 - 4.0 * g.edge_s / g.tick_s) / (1.0 - x * x);
}

TEST(LockIn, TheScaleFactorGrowsWithTheSquareOfLockIn) {
    for (const double rate : {20e3, 60e3, -60e3, 120e3}) {
        const LockInGyro g{.lock_hz = 300.0, .rate_arcsec_s = rate, .dithered = true, .by_slip_formula = true};
        const double error = scale_error(g, std::abs(rate) < 50e3 ? 2'000'000 : 500'000);
        EXPECT_NEAR(error / scale_error_formula(g), 1.0, 0.05) << rate;
    }
}

// The slip formula knows the pull on the plateaus by itself; the exact stepper has only Adler's equation.
TEST(LockIn, TheScaleFactorGrowsByTheExactStepperToo) {
    for (const double rate : {60e3, -120e3}) {
        const LockInGyro g{.lock_hz = 300.0, .rate_arcsec_s = rate, .dithered = true};
        EXPECT_NEAR(scale_error(g, 200'000) / scale_error_formula(g), 1.0, 0.05) << rate;
    }
}

// Mean error of the rate, as it is read and with what the core puts back, and the mean of what it claims of that.
struct PutBack {
    double plain_arcsec_s = 0.0;
    double left_arcsec_s = 0.0;
    double sigma_arcsec_s = 0.0;
};

void add_run(const LockInGyro& g, const core::LockInConfig& config, int n, double share, PutBack& sum) {
    const double edge_ratio = g.edge_s / g.tick_s;
    const core::CompensationConstants gyro{.tick = core::Seconds{g.tick_s},
                                           .bias = core::Hertz{g.bias_hz * (1.0 - edge_ratio)},
                                           .plateau_ratio = 1.0 / (1.0 - edge_ratio)};
    LockInRun run{g};
    run.mean_rate(200);
    const double to_rate = share * g.scale_arcsec / (n * g.tick_s);
    for (int i = 0; i < n; ++i) {
        const double plain = share / (n * g.tick_s) * run.tick() - share / n * g.rate_arcsec_s;
        const double first = run.seen_first(), second = run.seen_second();
        const core::LostCounts lost = core::lost_to_lock_in(gyro, config, first, second);
        sum.plain_arcsec_s += plain;
        sum.left_arcsec_s += plain + to_rate * lost.value;
        sum.sigma_arcsec_s += to_rate * std::sqrt(lost.variance);
    }
}

// Over rates within three dynamic zones to either side: near the bias each pulls towards its centre, in spite of the
// dither.
PutBack put_back(LockInGyro g, const core::LockInConfig& config, double rate_arcsec_s) {
    constexpr int n_rates = 60, n_ticks = 600;
    std::mt19937_64 random{7};
    std::uniform_real_distribution<double> beside{-3.0, 3.0};
    PutBack sum;
    for (int i = 0; i < n_rates; ++i) {
        g.rate_arcsec_s = rate_arcsec_s + beside(random) * zone_spacing_arcsec_s(g);
        g.start_turns = beside(random);
        add_run(g, config, n_ticks, 1.0 / n_rates, sum);
    }
    return sum;
}

// With the exact stepper, which knows Adler's equation alone. The walk of 300 Hz is 0.28 arcsec/sqrt(s), over 180 s; 60
// readings of whole counts over 3 s are rounded.
TEST(LockIn, ACalibratedThresholdTakesTheScaleErrorAway) {
    const core::LockInConfig known{.threshold = core::Hertz{300.0}};
    const double walk = 0.28 / std::sqrt(180.0);
    const double rounding = 3.263 / 3.0 / std::sqrt(6.0 * 60.0);
    for (const double rate : {0.0, 60e3, -120e3, 188e3, -188e3, 203e3, 400e3}) {
        for (const bool counts_only : {false, true}) {
            const LockInGyro g{.dithered = true, .counts_only = counts_only};
            const PutBack read = put_back(g, known, rate);
            const double noise = counts_only ? std::hypot(walk, rounding) : walk;
            const double near_bias = std::abs(rate) > 180e3 && std::abs(rate) < 210e3 ? 0.04 : 0.0;
            EXPECT_NEAR(read.left_arcsec_s, 0.0, 4.0 * noise + near_bias * std::abs(read.plain_arcsec_s)) << rate;
        }
    }
}

TEST(LockIn, AnUnknownThresholdOfItsPresumedSizeLeavesOneSigma) {
    const core::LockInConfig unknown{.sigma = core::Hertz{300.0}};
    for (const double rate : {-120e3, 188e3, 203e3}) {
        const PutBack read = put_back({.dithered = true}, unknown, rate);
        EXPECT_EQ(read.left_arcsec_s, read.plain_arcsec_s);
        EXPECT_NEAR(std::abs(read.plain_arcsec_s) / read.sigma_arcsec_s, 1.0, 0.05) << rate;
    }
}

TEST(DitheredEdges, LeaveNoBiasAtRest) {
    for (const double bias : {60000.0, 60140.0, 60320.0}) {
        for (const int helicity : {1, -1}) {
            const LockInGyro g{.bias_hz = bias, .helicity = helicity, .dithered = true};
            EXPECT_LT(std::abs(settled_rate(g, 0.0, 100'000)), 0.005) << bias << " " << helicity;
        }
    }
}

TEST(DitheredEdges, ReadASlowRotationWithinHalfAPercent) {
    for (const double bias : {60000.0, 60320.0}) {
        for (const double rate : {2.0, -2.0}) {
            const LockInGyro g{.bias_hz = bias, .dithered = true};
            EXPECT_NEAR(settled_rate(g, rate, 100'000) / rate, 1.0, 0.005) << bias << " " << rate;
        }
    }
    // A bias that is not what the law takes it for.
    EXPECT_NEAR(settled_rate({.dithered = true, .law_error = 0.01}, 2.0, 100'000) / 2.0, 1.0, 0.005);
    // By whole counts instead of phases: 500 s cannot hide more than a count.
    EXPECT_NEAR(settled_rate({.dithered = true, .counts_only = true}, 2.0, 100'000) / 2.0, 1.0, 0.005 + 0.0033);
}

TEST(DitheredEdges, LeaveNoStepAtTheDynamicZones) {
    for (const int k : {1, -1, 2}) {
        const LockInGyro g{.bias_hz = k % 2 == 0 ? 60320.0 : 60140.0, .dithered = true, .by_slip_formula = true};
        LockInGyro plain = g;
        plain.dithered = false;
        const double centre = k * zone_spacing_arcsec_s(g);
        ASSERT_GT(std::abs(settled_rate(plain, centre + 3.0, 8000) - (centre + 3.0)), 1.0);
        for (const double offset : {-10.0, -3.0, -1.0, -0.1, 0.0, 0.1, 1.0, 3.0, 10.0}) {
            // 300 s of a walk of 0.28 arcsec/sqrt(s) leave 0.016 arcsec/s.
            EXPECT_NEAR(settled_rate(g, centre + offset, 60'000), centre + offset, 0.065) << k << " " << offset;
        }
    }
}

TEST(DitheredEdges, WalkNoMoreThanRandomSlipsDo) {
    for (const double rate : {0.0, 2.0, 15.0, 45.0, 70.0, 400.0, 652.6, 5000.0}) {
        EXPECT_LT(walk({.rate_arcsec_s = rate, .dithered = true}, 6000).arw_deg_sqrt_h, 0.005) << rate;
    }
    for (const double rate : {100.0, 130.0, 163.0, 200.0}) {
        EXPECT_LT(walk({.rate_arcsec_s = rate, .dithered = true}, 2000).arw_deg_sqrt_h, 0.008) << rate;
    }
    // At slow rates what is left does not add up: over longer stretches it is far less.
    EXPECT_LT(walk({.rate_arcsec_s = 2.0, .dithered = true}, 200, 2000).arw_deg_sqrt_h, 0.0005);
}

TEST(DitheredEdges, ChooseTheirLawByTheRateThatTheyMeasure) {
    for (const auto& [rate, law] :
         {std::pair{2.0, core::DitherLaw::paired}, std::pair{30.0, core::DitherLaw::paired},
          std::pair{80.0, core::DitherLaw::random}, std::pair{-652.6, core::DitherLaw::random}}) {
        for (const int helicity : {1, -1}) {
            LockInRun run{{.rate_arcsec_s = rate, .helicity = helicity, .dithered = true}};
            run.mean_rate(2000);
            EXPECT_EQ(run.law(), law) << rate;
        }
    }
}

}  // namespace zlg::twin::lock_in_test
