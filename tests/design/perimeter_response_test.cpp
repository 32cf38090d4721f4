#include <zlg/design/perimeter_response.hpp>

#include <rapidcheck/gtest.h>

#include <zlg/design/error.hpp>

#include "test.hpp"

namespace zlg::design::perimeter_response_test {

using std::numbers::pi;
using Complex = std::complex<double>;

constexpr double rigid = std::numeric_limits<double>::infinity();
constexpr double degrees = 180.0 / pi;

Complex product(const PerimeterLoop& l, double w) {
    const Complex s{0.0, w};
    const double wm = 2.0 * pi * l.mirror_hz;
    return 1.0 / (s * l.tau_s) * std::exp(-s * l.delay_s) / (1.0 + s * l.rc_s) * (wm * wm) /
           (s * s + 2.0 * l.mirror_zeta * wm * s + wm * wm);
}

double real_between(double low, double high) {
    return low + (high - low) * *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(0, 1000001)) / 1e6;
}

PerimeterLoop any_loop() {
    PerimeterLoop l;
    l.tau_s = std::pow(10.0, real_between(-3.5, -1.5));
    l.delay_s = real_between(0.0, 0.01);
    l.rc_s = real_between(1e-5, 3e-3);
    l.mirror_hz = std::pow(10.0, real_between(2.0, 4.0));
    l.mirror_zeta = std::pow(10.0, real_between(-2.0, 0.0));
    return l;
}

// A sweep that knows nothing of the response's shape: crossings of the negative real axis and of the unit circle.
struct Sweep {
    double gain_margin = 1e300;
    double nearest_deg = 180.0;
    double last_phase_deg = 0.0;  // past -180, at the last unit gain
};

Sweep sweep(const PerimeterLoop& l) {
    Sweep found;
    constexpr double factor = 1.00004;
    double w = 1e-3 / l.tau_s;
    Complex before = product(l, w);
    double phase = std::arg(before);
    const double end = 3.0 * 2.0 * pi * l.mirror_hz;
    while (w < end) {
        w *= factor;
        const Complex now = product(l, w);
        phase += std::arg(now / before);
        if (before.imag() * now.imag() < 0.0 && now.real() < 0.0) {
            const double part = before.imag() / (before.imag() - now.imag());
            found.gain_margin =
                std::min(found.gain_margin, -1.0 / (before.real() + part * (now.real() - before.real())));
        }
        if ((std::abs(before) > 1.0) != (std::abs(now) > 1.0)) {
            found.nearest_deg = std::min(found.nearest_deg, std::abs(std::remainder(phase + pi, 2.0 * pi)) * degrees);
            found.last_phase_deg = phase * degrees;
        }
        before = now;
    }
    return found;
}

RC_GTEST_PROP(PerimeterResponseLaw, MarginsAreThoseOfABruteForceSweep, ()) {
    const PerimeterLoop l = any_loop();
    const Margins m = margins(l);
    const Sweep s = sweep(l);
    RC_ASSERT(std::abs(m.gain_margin / s.gain_margin - 1.0) < 1e-3);
    RC_PRE(std::abs(s.gain_margin - 1.0) > 1e-3);
    RC_ASSERT(m.stable == (s.gain_margin > 1.0));
    const double phase_margin = m.stable ? s.nearest_deg : 180.0 + s.last_phase_deg;
    RC_ASSERT(std::abs(m.phase_margin_deg - phase_margin) < 0.5);
    RC_ASSERT(std::abs(std::abs(product(l, m.crossover_rad_s)) - 1.0) < 1e-9);
}

TEST(PerimeterResponse, AnIntegratorWithDelayHasItsKnownMargins) {
    const Margins m = margins({0.0065, 0.00375, 0.0, rigid});
    EXPECT_NEAR(m.gain_margin, 0.5 * pi * 0.0065 / 0.00375, 1e-9);
    EXPECT_NEAR(m.limit_rad_s, 0.5 * pi / 0.00375, 1e-6);
    EXPECT_NEAR(m.crossover_rad_s, 1.0 / 0.0065, 1e-8);
    EXPECT_NEAR(m.phase_margin_deg, 90.0 - 0.00375 / 0.0065 * degrees, 1e-8);
    EXPECT_TRUE(m.stable);
    EXPECT_FALSE(margins({0.0065, 0.0065 * 0.5 * pi * 1.0001, 0.0, rigid}).stable);
    EXPECT_TRUE(margins({0.0065, 0.0065 * 0.5 * pi * 0.9999, 0.0, rigid}).stable);
}

TEST(PerimeterResponse, AnIntegratorWithOneLagHasNoLimitOfGain) {
    const Margins m = margins({0.0065, 0.0, 0.001, rigid});
    EXPECT_TRUE(m.stable);
    EXPECT_GT(m.gain_margin, 1e9);
    // tau^2 w^2 (1 + RC^2 w^2) = 1.
    const double v = (-1.0 + std::sqrt(1.0 + 4.0 * std::pow(0.001 / 0.0065, 2))) / (2.0 * 1e-6);
    EXPECT_NEAR(m.crossover_rad_s, std::sqrt(v), 1e-8);
    EXPECT_NEAR(m.phase_margin_deg, 90.0 - std::atan(std::sqrt(v) * 0.001) * degrees, 1e-8);
}

// Routh: s^3 + 2 zeta w_m s^2 + w_m^2 s + w_m^2/tau is stable for 1/tau < 2 zeta w_m.
TEST(PerimeterResponse, AMirrorLimitsTheGainByRouthsCriterion) {
    const double wm = 2.0 * pi * 5000.0;
    const Margins m = margins({0.0065, 0.0, 0.0, 5000.0, 0.05});
    EXPECT_NEAR(m.gain_margin, 2.0 * 0.05 * wm * 0.0065, 1e-6);
    EXPECT_NEAR(m.limit_rad_s, wm, 1e-4);
    EXPECT_TRUE(margins({1.001 / (0.1 * wm), 0.0, 0.0, 5000.0, 0.05}).stable);
    EXPECT_FALSE(margins({0.999 / (0.1 * wm), 0.0, 0.0, 5000.0, 0.05}).stable);
}

// A resonance that rises above unit gain makes a second and third crossover, far below -180 degrees.
TEST(PerimeterResponse, AResonanceAboveUnitGainIsUnstableWithANegativePhaseMargin) {
    const PerimeterLoop l{0.0005, 0.00005, 0.0, 1000.0, 0.02};
    ASSERT_GT(std::abs(product(l, 2.0 * pi * 1000.0)), 1.0);
    const Margins m = margins(l);
    EXPECT_FALSE(m.stable);
    EXPECT_LT(m.phase_margin_deg, 0.0);
    EXPECT_LT(m.crossover_rad_s, 2.0 * pi * 1000.0 * 0.9);
}

// A delay of one period of the mirror: -540 degrees exactly at the resonance, where |L| = 1/(2 zeta w_m tau).
TEST(PerimeterResponse, AResonanceMayLimitTheGainAtALaterTurn) {
    const Margins m = margins({0.05, 1.0 / 300.0, 0.0, 300.0, 0.01});
    EXPECT_NEAR(m.limit_rad_s, 2.0 * pi * 300.0, 1e-3);
    EXPECT_NEAR(m.gain_margin, 0.02 * 2.0 * pi * 300.0 * 0.05, 1e-6);
}

TEST(PerimeterResponse, LoopsOfThePaperAndOfTheTwin) {
    EXPECT_NEAR(margins({0.025}).phase_margin_deg, 79.0, 0.5);  // 5 T, the paper's rule
    EXPECT_NEAR(margins({0.010}).phase_margin_deg, 63.0, 0.5);  // 2 T
    EXPECT_NEAR(margins({0.0065}).phase_margin_deg, 50.0, 1.5);
    const double analog = margins({0.0065, 0.0}).phase_margin_deg;
    EXPECT_NEAR(analog, 81.3, 0.05);
}

// dl[k+1] = dl[k] - g dl[k-d] from a unit error.
double largest_after(double g, int d, int n) {
    std::vector<double> past(static_cast<std::size_t>(d + 1), 1.0);
    double largest = 0.0;
    for (int k = 0; k < n; ++k) {
        past.push_back(past.back() - g * past[past.size() - 1 - static_cast<std::size_t>(d)]);
        if (k >= n - 200) largest = std::max(largest, std::abs(past.back()));
    }
    return largest;
}

TEST(PerimeterResponse, TheSampledIntegratorIsStableUpToItsLimit) {
    EXPECT_NEAR(sampled_stability_limit(1), 1.0, 1e-15);
    EXPECT_NEAR(sampled_stability_limit(0), 2.0, 1e-15);
    for (int d = 0; d <= 6; ++d) {
        const double limit = sampled_stability_limit(d);
        EXPECT_LT(largest_after(0.99 * limit, d, 6000), 0.01) << d;
        EXPECT_GT(largest_after(1.01 * limit, d, 6000), 100.0) << d;
    }
}

TEST(PerimeterResponse, RefusesWhatIsOutOfRange) {
    const double nan = std::nan("");
    EXPECT_THROW((void)margins({0.0}), DesignError);
    EXPECT_THROW((void)margins({0.01, -1.0}), DesignError);
    EXPECT_THROW((void)margins({0.01, 0.0, nan}), DesignError);
    EXPECT_THROW((void)margins({0.01, 0.0, 0.0, 0.0}), DesignError);
    EXPECT_THROW((void)margins({0.01, 0.0, 0.0, 1.0, 0.0}), DesignError);
    EXPECT_THROW((void)sampled_stability_limit(-1), DesignError);
}

}  // namespace zlg::design::perimeter_response_test
