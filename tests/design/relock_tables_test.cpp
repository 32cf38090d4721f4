#include <zlg/design/relock_tables.hpp>

#include <zlg/design/error.hpp>

#include "test.hpp"

namespace zlg::design::relock_tables_test {

constexpr double T = table_tick_s;
constexpr Decay decays[] = {Decay::exponential, Decay::slew, Decay::slew_tail, Decay::critical};

double detuning(const RelockModel& m, double t) {
    const double change = m.time_s - m.tail_s;
    switch (m.decay) {
        case Decay::exponential: return std::exp(-t / m.time_s);
        case Decay::slew: return t < m.time_s ? 1.0 - t / m.time_s : 0.0;
        case Decay::slew_tail:
            return t < change ? 1.0 - t / m.time_s : m.tail_s / m.time_s * std::exp(-(t - change) / m.tail_s);
        case Decay::critical: return (1.0 + t / m.time_s) * std::exp(-t / m.time_s);
    }
    return 0.0;
}

// Means over a half by the midpoint rule.
HalfMeans summed(const RelockModel& m, int half) {
    constexpr int n = 20000;
    HalfMeans mean;
    for (int k = 0; k < n; ++k) {
        const double d = detuning(m, 0.5 * T * (half + (k + 0.5) / n));
        mean.d += d / n;
        mean.d_square += d * d / n;
    }
    return mean;
}

double rms(const TickDrifts& a, const TickDrifts& b) {
    double square = 0.0;
    for (std::size_t i = 0; i < 4; ++i) square += (a[i] - b[i]) * (a[i] - b[i]);
    return std::sqrt(square / 4.0);
}

TEST(RelockTables, TheDataAreThoseOfTheFiles) {
    const std::filesystem::path data = std::filesystem::path{ZLG_SHARED_DIR} / "data";
    if (!exists(data / "table1.csv") || !exists(data / "table2.csv")) GTEST_SKIP() << "no data beside the project";
    const auto column = [&](const char* file, int wanted) {
        std::vector<double> values;
        std::ifstream in{data / file};
        for (std::string line; std::getline(in, line);) {
            if (line.empty() || line[0] == '#' || line[0] == 't') continue;
            std::istringstream cells{line};
            std::string cell;
            for (int k = 0; k <= wanted; ++k) std::getline(cells, cell, ',');
            values.push_back(cell.empty() ? 0.0 : std::stod(cell));
        }
        return values;
    };
    const auto vector = [](const TickDrifts& d) { return std::vector<double>(d.begin(), d.end()); };
    EXPECT_EQ(column("table1.csv", 1), vector(measured_arcsec_s));
    EXPECT_EQ(column("table2.csv", 1), vector(measured_arcsec_s));
    EXPECT_EQ(column("table1.csv", 2), vector(table1_computed_arcsec_s));
    EXPECT_EQ(column("table2.csv", 2), vector(table2_computed_arcsec_s));
}

TEST(RelockTables, ThePrintedArithmeticOfTable1) {
    const auto raw = summarise(measured_arcsec_s, {});
    EXPECT_EQ(raw.mean_arcsec_s, 2131.25);
    EXPECT_NEAR(raw.angle_arcsec, 43, 0.5);
    EXPECT_NEAR(raw.angle_without_first_arcsec, 22, 0.5);
    const auto table = summarise(measured_arcsec_s, table1_computed_arcsec_s);
    EXPECT_EQ(table.residual_arcsec_s, (TickDrifts{4056, 557, 809, 29}));
    EXPECT_EQ(table.mean_arcsec_s, 1362.75);  // printed 1362, rounds to 1363
    EXPECT_NEAR(table.angle_arcsec, 27, 0.5);
    EXPECT_NEAR(table.angle_without_first_arcsec, 7, 0.5);
}

TEST(RelockTables, ThePrintedArithmeticOfTable2) {
    const auto table = summarise(measured_arcsec_s, table2_computed_arcsec_s);
    EXPECT_EQ(table.residual_arcsec_s, (TickDrifts{336, 571, -174, -71}));
    EXPECT_EQ(table.mean_arcsec_s, 165.5);
    EXPECT_NEAR(table.angle_arcsec, 3.3, 0.05);
    EXPECT_NEAR(table.rms_arcsec_s, 344, 0.5);
}

TEST(RelockTables, TheMeasuredDecayIsNoExponential) {
    const auto tau = local_time_constants_s(measured_arcsec_s);
    const double ms[] = {31.6, 12.2, 5.4};
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(tau[i] * 1e3, ms[i], 0.05);
}

TEST(RelockTables, TheMeansOverHalvesAreThoseOfTheMotion) {
    for (const Decay decay : decays) {
        const RelockModel m{decay, 1.0, 0.0163, 0.0055};
        for (int half = 0; half < 10; ++half) {
            const auto exact = half_means(m, half), sum = summed(m, half);
            EXPECT_NEAR(exact.d, sum.d, 2e-8) << half;
            EXPECT_NEAR(exact.d_square, sum.d_square, 2e-8) << half;
        }
    }
    // A tail longer than the line is an exponential from the start.
    EXPECT_NEAR(half_means({Decay::slew_tail, 1.0, 0.004, 0.006}, 3).d,
                half_means({Decay::exponential, 1.0, 0.006}, 3).d, 1e-15);
}

TEST(RelockTables, DriftAndDeficitAreHalfTheDifferenceAndTheSumOfTheHalves) {
    const RelockModel m{Decay::critical, 30000.0, 0.005};
    for (int i = 0; i < 4; ++i) {
        const double a = summed(m, 2 * i).d_square, b = summed(m, 2 * i + 1).d_square;
        EXPECT_NEAR(drift_arcsec_s(m)[static_cast<std::size_t>(i)], 15000.0 * (a - b), 1e-3);
        EXPECT_NEAR(deficit_arcsec_s(m)[static_cast<std::size_t>(i)], 15000.0 * (a + b), 1e-3);
    }
}

TEST(RelockTables, FitsOfFourLoopsToTheMeasuredDrift) {
    const double expected[] = {406, 117, 95, 151};
    for (std::size_t k = 0; k < 4; ++k) {
        const auto fit = fit_relock(decays[k], measured_arcsec_s);
        EXPECT_NEAR(fit.rms_arcsec_s, expected[k], 0.51) << fit.name;
        EXPECT_NEAR(rms(fit.drift_arcsec_s, measured_arcsec_s), fit.rms_arcsec_s, 1e-9);
        EXPECT_FALSE(fit.name.empty());
    }
}

// No point of a fine grid around and away from the fit is better.
TEST(RelockTables, TheFitsAreLeastSquares) {
    for (const Decay decay : decays) {
        const auto fit = fit_relock(decay, measured_arcsec_s);
        double least = 1e300;
        const int n_tails = decay == Decay::slew_tail ? 120 : 1;
        for (int a = 0; a < 400; ++a) {
            for (int b = 0; b < n_tails; ++b) {
                RelockModel m{decay, 1.0, 0.0008 * std::exp(0.01 * a), 0.0005 * std::exp(0.04 * b)};
                const auto unit = drift_arcsec_s(m);
                double product = 0.0, square = 0.0;
                for (std::size_t i = 0; i < 4; ++i) {
                    product += unit[i] * measured_arcsec_s[i];
                    square += unit[i] * unit[i];
                }
                m.deficit_arcsec_s = std::max(0.0, product / square);
                least = std::min(least, rms(drift_arcsec_s(m), measured_arcsec_s));
            }
        }
        EXPECT_LE(fit.rms_arcsec_s, least + 1e-9) << fit.name;
        EXPECT_NEAR(fit.rms_arcsec_s, least, 0.01 * least) << fit.name;
    }
}

TEST(RelockTables, AFitFindsTheLoopThatMadeTheDrifts) {
    for (const Decay decay : decays) {
        const RelockModel truth{decay, 34113.0, decay == Decay::slew_tail ? 0.0163 : 0.011, 0.0055};
        const auto fit = fit_relock(decay, drift_arcsec_s(truth));
        EXPECT_LT(fit.rms_arcsec_s, 0.05) << fit.name;
        EXPECT_NEAR(fit.model.time_s / truth.time_s, 1.0, 1e-3) << fit.name;
    }
}

// Slope 0.28 dl0 per tick and a tail of 1.1 ticks, with the deficit of least squares.
TEST(RelockTables, TheFormulaOfTheSlewLoop) {
    RelockModel m{Decay::slew_tail, 1.0, T / 0.28, 1.1 * T};
    const auto unit = drift_arcsec_s(m);
    double product = 0.0, square = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
        product += unit[i] * measured_arcsec_s[i];
        square += unit[i] * unit[i];
    }
    m.deficit_arcsec_s = product / square;
    EXPECT_NEAR(m.deficit_arcsec_s, 34412, 1);
    const double printed[] = {4143, 2794, 1366, 245};
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(drift_arcsec_s(m)[i], printed[i], 0.6);
}

TEST(RelockTables, OnAnExponentialBothCorrectionsAreExact) {
    const RelockModel m{Decay::exponential, 34113.0, 3.5 * T};
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(corrected_by_frequency_arcsec_s(m)[i], drift_arcsec_s(m)[i], 1e-8);
        EXPECT_NEAR(corrected_by_detuning_arcsec_s(m)[i], drift_arcsec_s(m)[i], 1e-8);
    }
}

TEST(RelockTables, TheFittedSlewLoopPredictsHowTheCorrectionByFrequencyFails) {
    const auto fit = fit_relock(Decay::slew_tail, measured_arcsec_s);
    const auto corrected = corrected_by_frequency_arcsec_s(fit.model);
    const double bias[] = {525, 457, 67};
    for (std::size_t i = 1; i < 4; ++i) EXPECT_NEAR(fit.drift_arcsec_s[i] - corrected[i], bias[i - 1], 1.0);
    // Tick 1 has the q of the first two ticks.
    const double q = std::sqrt(deficit_arcsec_s(fit.model)[1] / deficit_arcsec_s(fit.model)[0]);
    EXPECT_NEAR(corrected[0], deficit_arcsec_s(fit.model)[0] * (1.0 - q) / (1.0 + q), 1e-8);
    // Tick 1 of (11) is left: 26 arcsec in all, 25 on the critically damped loop.
    const auto left = [](const RelockFit& f) {
        const auto c = corrected_by_frequency_arcsec_s(f.model);
        return T * (f.drift_arcsec_s[0] + f.drift_arcsec_s[1] - c[1] + f.drift_arcsec_s[2] - c[2] +
                    f.drift_arcsec_s[3] - c[3]);
    };
    EXPECT_NEAR(left(fit), 26, 0.5);
    EXPECT_NEAR(left(fit_relock(Decay::critical, measured_arcsec_s)), 25, 0.5);
}

TEST(RelockTables, TheCorrectionByDetuningHardlyFailsOnAnyLoop) {
    for (const Decay decay : {Decay::slew_tail, Decay::critical}) {
        const auto fit = fit_relock(decay, measured_arcsec_s);
        const auto corrected = corrected_by_detuning_arcsec_s(fit.model);
        double left = 0.0;
        for (std::size_t i = 0; i < 4; ++i) left += T * (fit.drift_arcsec_s[i] - corrected[i]);
        EXPECT_NEAR(left, decay == Decay::slew_tail ? -0.15 : -0.18, 0.1);
    }
}

TEST(RelockTables, ALoopThatHasStoppedHasNoCorrection) {
    const RelockModel m{Decay::slew, 34113.0, 0.012};
    EXPECT_TRUE(std::isnan(corrected_by_frequency_arcsec_s(m)[3]));
    EXPECT_TRUE(std::isnan(corrected_by_detuning_arcsec_s(m)[3]));
}

TEST(RelockTables, RefusesWhatIsOutOfRange) {
    EXPECT_THROW((void)drift_arcsec_s({Decay::exponential, 1.0, 0.0}), DesignError);
    EXPECT_THROW((void)drift_arcsec_s({Decay::slew_tail, 1.0, 0.01, 0.0}), DesignError);
    EXPECT_THROW((void)drift_arcsec_s({Decay::slew, -1.0, 0.01}), DesignError);
    EXPECT_THROW((void)half_means({Decay::slew, 1.0, 0.01}, -1), DesignError);
    EXPECT_THROW((void)fit_relock(Decay::slew, {1.0, std::nan(""), 0.0, 0.0}), DesignError);
}

}  // namespace zlg::design::relock_tables_test
