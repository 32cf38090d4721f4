#include <zlg/twin/four_wave.hpp>

#include "laser_reference.hpp"

namespace zlg::twin::four_wave_test {

double slope(const FourWave& laser, double field_g) { return laser.at(1e-5, field_g).discriminator() / 1e-5; }

LaserConfig with_gain(double gain_loss_ratio) { return {.gain_loss_ratio = gain_loss_ratio}; }

// ---- values of the published model at a perimeter of 16 cm, loss 0.7 %

TEST(FourWave, TheBiasOf15GaussIs60430Hz) {
    EXPECT_NEAR(FourWave{LaserConfig{}}.at(0.0, 15.0).left.bias_hz, 60430.0, 5.0);
}

TEST(FourWave, TheBiasFallsWithTheSquareOfDetuning) {
    const FourWave laser{LaserConfig{}};
    const double f0 = laser.at(0.0, 15.0).left.bias_hz;
    const auto chi = [&](double dl) { return (1.0 - laser.at(dl, 15.0).left.bias_hz / f0) / (dl * dl); };
    EXPECT_NEAR(chi(0.1), 3.587, 0.001);
    EXPECT_NEAR(chi(0.2), 3.555, 0.001);
}

TEST(FourWave, TheDiscriminatorsSlopeGrowsWithTheField) {
    const FourWave laser{LaserConfig{}};
    EXPECT_NEAR(slope(laser, 10.0), 0.222, 0.02 * 0.222);
    EXPECT_NEAR(slope(laser, 15.0), 0.332, 0.02 * 0.332);
    EXPECT_NEAR(slope(laser, 20.0), 0.446, 0.02 * 0.446);
}

TEST(FourWave, TheDiscriminatorsSlopeFallsWithTheGain) {
    EXPECT_NEAR(slope(FourWave{with_gain(1.1)}, 15.0), 0.67, 0.01);
    EXPECT_NEAR(slope(FourWave{with_gain(1.3)}, 15.0), 0.22, 0.01);
}

TEST(FourWave, TheDiscriminatorIsExpansive) {
    const FourWave laser{LaserConfig{}};
    const auto growth = [&](double dl) { return laser.at(dl, 15.0).discriminator() / (dl * slope(laser, 15.0)); };
    EXPECT_NEAR(growth(0.05), 1.05, 0.01);
    EXPECT_NEAR(growth(0.10), 1.24, 0.01);
    EXPECT_NEAR(growth(0.15), 1.78, 0.01);
    EXPECT_NEAR(growth(0.20), 3.7, 0.05);
}

TEST(FourWave, BetweenTheModesLightOf20GaussRunsOneWay) {
    const LaserLight light = FourWave{LaserConfig{}}.at(0.25, 20.0);
    EXPECT_EQ(light.lit(), 1U | 4U);
    EXPECT_FALSE(light.of(1).two_way());
    EXPECT_FALSE(light.of(-1).two_way());
    EXPECT_EQ(light.ccw(), 0.0);
    EXPECT_GT(light.cw(), 0.1);
    EXPECT_EQ(light.discriminator(), 1.0);
}

// ---- the same equations from their definitions

void expect_equal(const LaserLight& light, const ReferenceLaser& reference, double tolerance) {
    EXPECT_NEAR(light.left.cw, reference.intensity[0], tolerance);
    EXPECT_NEAR(light.left.ccw, reference.intensity[1], tolerance);
    EXPECT_NEAR(light.right.cw, reference.intensity[2], tolerance);
    EXPECT_NEAR(light.right.ccw, reference.intensity[3], tolerance);
    EXPECT_NEAR(light.left.bias_hz, reference.pulling_hz[0] - reference.pulling_hz[1], 1e-4);
    EXPECT_NEAR(light.right.bias_hz, reference.pulling_hz[2] - reference.pulling_hz[3], 1e-4);
}

TEST(FourWave, AgreesWithQuadratureAndGrowthInTime) {
    const LaserConfig config;
    const FourWave laser{config};
    const ReferenceGas reference{config};
    for (const double p : {0.03, 0.17, 0.225, 0.25, 0.28, 0.41}) {
        SCOPED_TRACE(p);
        expect_equal(laser.at(p, 15.0), reference.at(p, p - 0.5, 15.0), 1e-9);
    }
    expect_equal(laser.at(-0.22, -11.0), reference.at(-0.22, 0.28, -11.0), 1e-9);
}

TEST(FourWave, AgreesWithQuadratureForGasOfUnequalIsotopes) {
    const LaserConfig config{.perimeter_m = 0.28,
                             .gain_loss_ratio = 1.15,
                             .doppler_half_width_hz = 950e6,
                             .homogeneous_half_width_hz = 90e6,
                             .isotope_shift_hz = 1000e6,
                             .upper_isotope_ratio = 0.465,
                             .zeeman_hz_per_g = 1.7e6,
                             .opposite_sigma_coupling = 0.8};
    LaserConfig far_apart = config;
    far_apart.perimeter_m = 0.12;
    const FourWave laser{far_apart};
    const ReferenceGas reference{far_apart};
    for (const double p : {-0.23, -0.05, 0.04, 0.1}) {
        SCOPED_TRACE(p);
        expect_equal(laser.at(p, 12.0), reference.at(p, p < 0.0 ? p + 0.5 : p - 0.5, 12.0), 1e-9);
    }
}

LaserConfig saturated(LaserConfig config) {
    config.dispersion = Dispersion::saturated;
    return config;
}

TEST(FourWave, TheSaturatedBiasAgreesWithQuadrature) {
    const LaserConfig unequal{.upper_isotope_ratio = 0.465, .opposite_sigma_coupling = 0.8};
    for (const LaserConfig& gas : {LaserConfig{}, unequal}) {
        const LaserConfig config = saturated(gas);
        const FourWave laser{config};
        const ReferenceGas reference{config};
        for (const double p : {-0.1, 0.0, 0.05, 0.17, 0.225, 0.25, 0.28}) {
            SCOPED_TRACE(p);
            const double other = p < 0.0 ? p + 0.5 : p - 0.5;
            const LaserLight light = laser.at(p, 15.0);
            const ReferenceLaser expected = reference.at(p, other, 15.0);
            const double left_hz = expected.pulling_hz[0] - expected.pulling_hz[1];
            const double right_hz = expected.pulling_hz[2] - expected.pulling_hz[3];
            EXPECT_NEAR(light.left.bias_hz, left_hz, 1e-6 * std::abs(left_hz));
            EXPECT_NEAR(light.right.bias_hz, right_hz, 1e-6 * std::abs(right_hz));
        }
    }
}

// Figures of a quadrature in another language, by others.
TEST(FourWave, TheHolesOfTheDefaultGasTakeTheParabolaFromTheBias) {
    const FourWave laser{saturated({})};
    const double centre_hz = laser.at(0.0, 15.0).left.bias_hz;
    EXPECT_NEAR(centre_hz, 57391.0, 1.0);
    const auto chi = [&](double dl) { return (1.0 - laser.at(dl, 15.0).left.bias_hz / centre_hz) / (dl * dl); };
    EXPECT_NEAR(chi(0.05), 0.27, 0.01);
    EXPECT_NEAR(chi(0.10), 0.02, 0.01);
    EXPECT_NEAR(chi(0.15), -0.41, 0.01);
    EXPECT_NEAR(chi(0.20), -0.29, 0.01);
}

// ---- limits and symmetries

TEST(FourWave, WithoutFieldThereIsNoBiasAndTheBeamsAreEqual) {
    const FourWave laser{LaserConfig{}};
    for (double p = -0.6; p < 0.6; p += 0.013) {
        const LaserLight light = laser.at(p, 0.0);
        EXPECT_NEAR(light.left.bias_hz, 0.0, 1e-9);
        EXPECT_NEAR(light.right.bias_hz, 0.0, 1e-9);
        EXPECT_NEAR(light.left.cw, light.left.ccw, 1e-14);
        EXPECT_NEAR(light.right.cw, light.right.ccw, 1e-14);
    }
}

void expect_same(const WavePair& a, const WavePair& b) {
    EXPECT_NEAR(a.cw, b.cw, 1e-12);
    EXPECT_NEAR(a.ccw, b.ccw, 1e-12);
    EXPECT_NEAR(a.bias_hz, b.bias_hz, 1e-6);
}

TEST(FourWave, AReversedFieldExchangesTheBeams) {
    const FourWave laser{saturated({.upper_isotope_ratio = 0.465})};
    for (double p = -0.49; p < 0.5; p += 0.017) {
        const LaserLight a = laser.at(p, 17.0);
        const LaserLight b = laser.at(p, -17.0);
        expect_same(a.left, {b.left.ccw, b.left.cw, -b.left.bias_hz});
        expect_same(a.right, {b.right.ccw, b.right.cw, -b.right.bias_hz});
    }
}

TEST(FourWave, HalfAWavelengthExchangesTheHelicitiesAndReversesTheField) {
    const FourWave laser{saturated({.upper_isotope_ratio = 0.465})};
    for (double p = -0.49; p < 0.5; p += 0.017) {
        const LaserLight a = laser.at(p, 15.0);
        const LaserLight b = laser.at(p + 2.5, -15.0);
        expect_same(a.left, b.right);
        expect_same(a.right, b.left);
        expect_same(laser.at(p - 3.0, 15.0).left, a.left);
    }
}

TEST(FourWave, WithEqualIsotopesTheBiasIsEvenAndTheDiscriminatorOddInDetuning) {
    const FourWave laser{LaserConfig{}};
    for (double p = 0.005; p < 0.5; p += 0.011) {
        const LaserLight a = laser.at(p, 15.0);
        const LaserLight b = laser.at(-p, 15.0);
        expect_same(a.left, {b.left.ccw, b.left.cw, b.left.bias_hz});
        EXPECT_NEAR(a.discriminator(), -b.discriminator(), 1e-11);
    }
}

// One wave's gain, saturated by itself and by the same hole, met from the other side only at the line centre.
TEST(FourWave, OneIsotopeShowsTheLambDip) {
    const LaserConfig config{.gain_loss_ratio = 1.05, .homogeneous_half_width_hz = 9.07e6, .isotope_shift_hz = 0.0};
    const FourWave laser{config};
    const double range_hz = 299792458.0 / config.perimeter_m;
    for (const double off_hz : {0.0, 5e6, 10e6, 20e6, 40e6}) {
        // Doppler limit, y = 0.01: gain exp(-x^2), saturation by the own hole 1/2 and by the other
        // p/2 gamma^2/(gamma^2 + off^2), both in parts of the gain.
        const double x = off_hz / config.doppler_half_width_hz;
        const double meeting = config.opposite_sigma_coupling / (1.0 + std::pow(off_hz / 9.07e6, 2));
        const double maxwell = std::exp(-x * x);
        const double expected = (1.05 * maxwell - 1.0) / (1.05 * 0.5 * maxwell * (1.0 + meeting));
        const LaserLight light = laser.at(off_hz / range_hz, 0.0);
        EXPECT_NEAR(light.left.cw / expected, 1.0, 0.03) << off_hz;
        EXPECT_NEAR(light.left.cw, light.left.ccw, 1e-12);
    }
    const double dip = laser.at(0.0, 0.0).left.cw / laser.at(30e6 / range_hz, 0.0).left.cw;
    EXPECT_LT(dip, 0.7);
}

// One isotope at the line centre: pulling is that of a Voigt line, whose slope there is known in closed form.
TEST(FourWave, AWeakFieldGivesTheBiasOfTheVoigtSlope) {
    const LaserConfig config{.gain_loss_ratio = 1.08, .isotope_shift_hz = 0.0};
    const double y = config.homogeneous_half_width_hz / config.doppler_half_width_hz;
    const double erfcx = std::exp(y * y) * std::erfc(y);
    const double slope = 2.0 * std::numbers::inv_sqrtpi * (1.0 - y / std::numbers::inv_sqrtpi * erfcx) / erfcx;
    const double shift = config.zeeman_hz_per_g * 0.01 / config.doppler_half_width_hz;
    const double range_hz = 299792458.0 / config.perimeter_m;
    const double expected_hz =
        range_hz / (2.0 * std::numbers::pi) * 1.08 * config.round_trip_loss_ratio * slope * shift;
    EXPECT_NEAR(FourWave{config}.at(0.0, 0.01).left.bias_hz, expected_hz, 1e-7 * expected_hz);
}

// The n-th derivative by x of int W(v) K(x - v) dv, n = 0..3, all of it on the Maxwell distribution.
template <class Kernel> double maxwell(int n, double x, const Kernel& kernel) {
    constexpr double h = 1e-3;
    double sum = 0.0;
    for (int k = -8000; k <= 8000; ++k) {
        const double v = h * k;
        const double hermite[] = {1.0, -2.0 * v, 4.0 * v * v - 2.0, v * (12.0 - 8.0 * v * v)};
        sum += hermite[n] * std::exp(-v * v) * kernel(x - v);
    }
    return h * std::numbers::inv_sqrtpi * sum;
}

// The default gas in units of ku: isotopes of equal share at +-line.
struct EvenGas {
    LaserConfig config;
    double y = config.homogeneous_half_width_hz / config.doppler_half_width_hz;
    double line = 0.5 * config.isotope_shift_hz / config.doppler_half_width_hz;
    double range = 299792458.0 / config.perimeter_m / config.doppler_half_width_hz;

    [[nodiscard]] double lorentz(double u) const { return y * y / (y * y + u * u); }

    template <class Kernel> [[nodiscard]] double both(int n, double x, const Kernel& kernel) const {
        return 0.5 * (maxwell(n, x - line, kernel) + maxwell(n, x + line, kernel));
    }
};

// A weak field takes the slope of the dispersion D, so that eq (2) has half the ratio of its third derivative to its
// first, with the other sign.
TEST(FourWave, ForSmallDetuningsChiIsTheCurvatureOfTheDispersion) {
    const EvenGas gas;
    const auto dispersion = [&](double u) { return gas.y * u / (gas.y * gas.y + u * u); };
    const double chi = -0.5 * gas.both(3, 0.0, dispersion) / gas.both(1, 0.0, dispersion) * gas.range * gas.range;
    EXPECT_NEAR(chi, 3.59, 0.01 * 3.59);
    const FourWave laser{gas.config};
    const auto bias_hz = [&](double dl) { return laser.at(dl, 0.1).left.bias_hz; };
    EXPECT_NEAR((1.0 - bias_hz(0.01) / bias_hz(0.0)) / 1e-4, chi, 1e-3);
}

// Two waves, perturbed about equal ones of intensity I = (g - mu/G)/(S + C): gain g and self-saturation S of each
// change with its detuning by g' and S', the cross-saturation C does not, and (I1 - I2)/(I1 + I2) = (g'/I - S')/(S - C)
// dl.
TEST(FourWave, ForSmallDetuningsTheDiscriminatorIsThatOfThePerturbedBalance) {
    const EvenGas gas;
    const auto line = [&](double u) { return gas.lorentz(u); };
    const auto squared = [&](double u) { return gas.lorentz(u) * gas.lorentz(u); };
    const double loss_over_gain = gas.both(0, 0.0, line) / gas.config.gain_loss_ratio;
    const FourWave laser{gas.config};
    for (const double field_g : {0.5, 5.0, 15.0, 20.0}) {
        const double z = gas.config.zeeman_hz_per_g * field_g / gas.config.doppler_half_width_hz;
        // Among the velocities the other wave burns its hole on the other side of the isotope's line.
        const auto overlap = [&](double at) {
            return maxwell(0, at - z, [&](double u) { return gas.lorentz(u) * gas.lorentz(u - 2.0 * at); });
        };
        const double cross = gas.config.opposite_sigma_coupling * 0.5 * (overlap(gas.line) + overlap(-gas.line));
        const double self = gas.both(0, z, squared);
        const double intensity = (gas.both(0, z, line) - loss_over_gain) / (self + cross);
        // The field has raised the line of cw: a larger detuning brings the wave nearer to it.
        const double slope_per_ku = (-gas.both(1, z, line) / intensity + gas.both(1, z, squared)) / (self - cross);
        EXPECT_NEAR(laser.at(0.0, field_g).left.cw, intensity, 1e-9) << field_g;
        EXPECT_NEAR(slope(laser, field_g) / (slope_per_ku * gas.range), 1.0, 1e-6) << field_g;
    }
}

TEST(FourWave, AtThresholdTheLightVanishesLinearly) {
    const double at_1_per_mille = FourWave{with_gain(1.001)}.at(0.0, 0.0).left.cw;
    const double at_2_per_mille = FourWave{with_gain(1.002)}.at(0.0, 0.0).left.cw;
    EXPECT_NEAR(at_2_per_mille / at_1_per_mille, 2.0 * 1.001 / 1.002, 1e-9);
    EXPECT_TRUE(FourWave{with_gain(0.999)}.at(0.0, 0.0).left.dark());
}

TEST(FourWave, IntensitiesAreContinuousAcrossZoneEdges) {
    for (const double field_g : {0.0, 10.0, 15.0, 20.0}) {
        const FourWave laser{LaserConfig{}};
        LaserLight last = laser.at(0.15, field_g);
        for (double p = 0.15; p < 0.35; p += 1e-5) {
            const LaserLight light = laser.at(p, field_g);
            ASSERT_NEAR(light.left.cw, last.left.cw, 5e-4) << p;
            ASSERT_NEAR(light.left.ccw, last.left.ccw, 5e-4) << p;
            ASSERT_NEAR(light.right.cw, last.right.cw, 5e-4) << p;
            ASSERT_NEAR(light.right.ccw, last.right.ccw, 5e-4) << p;
            last = light;
        }
    }
}

}  // namespace zlg::twin::four_wave_test
