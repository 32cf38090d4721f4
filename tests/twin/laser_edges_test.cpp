// The laser at the edges of its parameters: a right result or a clean refusal_of_twin, never a hang or a number that is
// none.

#include <zlg/twin/averaged_laser.hpp>
#include <zlg/twin/four_wave.hpp>
#include <zlg/twin/laser_table.hpp>
#include <zlg/twin/laser_zones.hpp>

#include "laser_gyro.hpp"

namespace zlg::twin::laser_edges_test {

LaserConfig one_line(double gain_loss_ratio, double opposite_sigma_coupling) {
    return {.gain_loss_ratio = gain_loss_ratio,
            .isotope_shift_hz = 0.0,
            .opposite_sigma_coupling = opposite_sigma_coupling};
}

std::string refusal_of_twin(const LaserConfig& laser) {
    TwinConfig config = as_laser(quiet_gyro());
    config.laser = laser;
    return test::refusal_by<std::exception>([&] { Twin twin{config, Motion::rest()}; });
}

bool is_sane(const WavePair& pair) {
    return pair.cw >= 0.0 && pair.ccw >= 0.0 && std::isfinite(pair.cw + pair.ccw + pair.bias_hz);
}

TEST(LaserEdges, EveryPlaceHasLightOrNoneWhateverTheGas) {
    const LaserConfig gases[] = {{.gain_loss_ratio = 1.0},
                                 {.gain_loss_ratio = 1.0 + 1e-15},
                                 {.gain_loss_ratio = 1.0 + 1e-6},
                                 {.opposite_sigma_coupling = 1.0},
                                 {.opposite_sigma_coupling = 0.0},
                                 {.gain_loss_ratio = 1.05, .upper_isotope_ratio = 0.0},
                                 {.gain_loss_ratio = 1.05, .upper_isotope_ratio = 1.0},
                                 one_line(1.2, 0.6),
                                 one_line(1.2, 1.0),
                                 {.zeeman_hz_per_g = 0.0}};
    for (const LaserConfig& gas : gases) {
        const FourWave laser{gas};
        for (const double field_g : {-15.0, -1e-9, 0.0, 1e-9, 15.0, 1e4}) {
            for (double p = -0.5; p <= 0.5; p += 0.01) {
                const LaserLight light = laser.at(p, field_g);
                ASSERT_TRUE(is_sane(light.left) && is_sane(light.right)) << p << " " << field_g;
                ASSERT_LE(std::abs(light.discriminator()), 1.0);
            }
        }
    }
}

// Both waves of a centred mode burn the same hole: they share a single wave's light at coupling 0, and at 1 one wins.
TEST(LaserEdges, OneIsotopeAndFullCouplingLeaveOneWaveAtTheCentre) {
    const LaserLight apart = FourWave{one_line(1.1, 0.0)}.at(0.0, 0.0);
    const LaserLight shared = FourWave{one_line(1.1, 1.0)}.at(0.0, 0.0);
    EXPECT_TRUE(apart.left.two_way());
    EXPECT_FALSE(shared.left.two_way());
    EXPECT_NEAR(shared.left.cw + shared.left.ccw, apart.left.cw, 1e-12);
}

TEST(LaserEdges, AGyroWithoutLightBothWaysIsRefused) {
    EXPECT_NE(refusal_of_twin(one_line(1.1, 1.0)), "");
    // The field takes what little gain there is.
    test::expect_contains(refusal_of_twin({.gain_loss_ratio = 1.0001}), "not lit both ways");
    // The only line is a quarter of a wavelength off the zero of detuning.
    test::expect_contains(refusal_of_twin({.gain_loss_ratio = 1.04, .upper_isotope_ratio = 1.0}), "no equal beams");
}

TEST(LaserEdges, AGyroWithoutFieldIsRefused) {
    test::expect_contains(refusal_of_twin({.bias_field_g = 0.0}), "bias_field_g is 0");
    test::expect_contains(refusal_of_twin({.zeeman_hz_per_g = 0.0}), "zeeman_hz_per_g is 0");
    EXPECT_NE(refusal_of_twin({.bias_field_g = 1e4}), "");
}

// Little above threshold light is lost a few hundredths of a wavelength off the centre; within them it is a gyro, with
// a discriminator as 1/(G/mu - 1).
TEST(LaserEdges, LittleGainMakesAGyroOfAShortRange) {
    double last_slope = 0.0;
    double last_range = 0.25;
    for (const double excess : {0.10, 0.05, 0.02, 0.01}) {
        const FourWave laser{LaserConfig{.gain_loss_ratio = 1.0 + excess}};
        const AveragedLaser a = averaged_laser(laser, 15.0);
        const double range = laser_zones(laser, 15.0, 0.0, 0.25).front().to_lambda;
        EXPECT_EQ(a.settled_lambda, 0.0);
        EXPECT_GT(a.discriminator_per_lambda, last_slope);
        EXPECT_NEAR(a.discriminator_per_lambda * excess, 0.067, 0.005) << excess;
        EXPECT_LT(range, last_range);
        EXPECT_EQ(refusal_of_twin({.gain_loss_ratio = 1.0 + excess}), "");
        last_slope = a.discriminator_per_lambda;
        last_range = range;
    }
}

TEST(LaserEdges, AWeakFieldKeepsTheLawOfAStrongOne) {
    const FourWave laser{LaserConfig{}};
    for (const double field_g : {1e-6, 1e-3, 1.0}) {
        const AveragedLaser a = averaged_laser(laser, field_g);
        EXPECT_NEAR(a.bias_hz / field_g, 60430.0 / 15.0, 0.01 * 60430.0 / 15.0) << field_g;
        EXPECT_NEAR(a.discriminator_per_lambda / field_g, 0.332 / 15.0, 0.01 * 0.332 / 15.0) << field_g;
        EXPECT_LE((LaserTable{LaserConfig{}, field_g}.error()), LaserTable::max_error) << field_g;
    }
}

// Beats of nearly equal size are followed sample by sample; a rotation that no gyro knows must not make that endless.
TEST(LaserEdges, AnAbsurdRotationBetweenTheModesIsSteppedInTime) {
    Twin twin{as_laser(held_gyro(), 150.0), Motion::sines(1e15, {})};
    const auto start = std::chrono::steady_clock::now();
    advance(twin, frame(true, 1, 150.0 + 80.0 * 0.25), 8);
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 30.0);
}

}  // namespace zlg::twin::laser_edges_test
