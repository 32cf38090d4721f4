#include <zlg/config/schema.hpp>
#include <zlg/rig/laser_agreement.hpp>
#include <zlg/rig/laser_calibration.hpp>

#include "test.hpp"

namespace zlg::laser_agreement_test {

config::Config laser(std::initializer_list<const char*> settings) {
    config::Config c;
    config::apply_set(c, "gyro.fidelity=laser");
    for (const char* setting : settings) config::apply_set(c, setting);
    return c;
}

std::string all(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) text += line + '\n';
    return text;
}

TEST(LaserAgreement, all_constants_are_taken_together) {
    const config::Config c = laser({"laser.perimeter_m=0.12"});
    const rig::LaserAgreement made = rig::agreed_with_laser(c);
    const config::Config calibrated = rig::calibrated_by_laser(c);
    EXPECT_EQ(made.config.gyro.bias_hz, calibrated.gyro.bias_hz);
    EXPECT_EQ(made.config.gyro.bias_chi, calibrated.gyro.bias_chi);
    EXPECT_EQ(made.config.gyro.discriminator_per_lambda, calibrated.gyro.discriminator_per_lambda);
    EXPECT_EQ(made.config.perimeter.discriminator_signal, calibrated.perimeter.discriminator_signal);
    // 4 lambda/L of a square ring, 632.8 nm, in arcsec.
    EXPECT_NEAR(made.config.gyro.scale_arcsec, 4.0 * 632.8e-9 / 0.12 * 206264.806, 1e-3);
    EXPECT_TRUE(made.warnings.empty());
    ASSERT_EQ(made.notes.size(), 1u);
    for (const char* key :
         {"gyro.bias_hz = 79", "gyro.bias_chi = 6.37", "gyro.scale_arcsec = 4.35", "discriminator_signal"})
        EXPECT_NE(made.notes[0].find(key), std::string::npos) << made.notes[0];
}

// The case of one constant out of four: it agrees, so that the others follow.
TEST(LaserAgreement, what_is_given_and_agrees_lets_the_others_follow) {
    const rig::LaserAgreement made = rig::agreed_with_laser(laser({"laser.perimeter_m=0.12", "gyro.bias_hz=79766.7"}));
    EXPECT_EQ(made.config.gyro.bias_hz, 79766.7);
    EXPECT_NEAR(made.config.gyro.bias_chi, 6.37, 0.01);
    EXPECT_TRUE(made.warnings.empty());
}

TEST(LaserAgreement, a_contradiction_is_named_with_both_values_and_stays) {
    const rig::LaserAgreement made = rig::agreed_with_laser(laser({"laser.perimeter_m=0.12", "gyro.bias_chi=4.5"}));
    EXPECT_EQ(made.config.gyro.bias_chi, 4.5);
    EXPECT_NEAR(made.config.gyro.bias_hz, 79766.7, 1.0);
    EXPECT_EQ(made.notes.size(), 1u);
    ASSERT_EQ(made.warnings.size(), 1u);
    zlg::test::expect_contains(made.warnings[0], "gyro.bias_chi = 4.5 is presumed, [laser] makes 6.37");
}

TEST(LaserAgreement, a_slope_that_is_given_alone_stays_the_whole_law) {
    const rig::LaserAgreement made = rig::agreed_with_laser(laser({"gyro.discriminator_per_lambda=0.3315"}));
    EXPECT_TRUE(made.config.perimeter.discriminator_signal.empty());
    EXPECT_TRUE(made.warnings.empty());
}

// A value that is given is given, though it be the default.
TEST(LaserAgreement, a_default_that_is_given_contradicts_like_any_other) {
    const rig::LaserAgreement made = rig::agreed_with_laser(laser({"laser.perimeter_m=0.12", "gyro.bias_chi=3.6"}));
    EXPECT_EQ(made.config.gyro.bias_chi, 3.6);
    zlg::test::expect_contains(all(made.warnings), "gyro.bias_chi = 3.6 is presumed, [laser] makes 6.37");
}

TEST(LaserAgreement, a_calibrated_processor_agrees) {
    const config::Config c = rig::calibrated_by_laser(laser({"laser.gain_loss_ratio=1.1"}));
    const rig::LaserAgreement made = rig::agreed_with_laser(c);
    EXPECT_EQ(config::to_toml(made.config), config::to_toml(c));
    EXPECT_TRUE(made.warnings.empty());
    EXPECT_TRUE(made.notes.empty());
}

TEST(LaserAgreement, the_walk_of_lock_in_and_the_counts_of_a_fringe_follow_too) {
    const rig::LaserAgreement made = rig::agreed_with_laser(laser(
        {"laser.lock_in_left_hz=300", "laser.lock_in_right_hz=300", "laser.quadrature=x4", "laser.beam_power_w=0"}));
    // docs/physics.md: 0.0047 deg/sqrt(h) at 300 Hz; 60 arcsec/sqrt(s) are a deg/sqrt(h).
    EXPECT_NEAR(made.config.drift.random_walk_arcsec_sqrt_s, 0.0047 * 60.0, 0.003);
    EXPECT_NEAR(made.config.gyro.scale_arcsec, 3.263 / 4.0, 1e-9);
    EXPECT_NEAR(made.config.gyro.bias_hz, 4.0 * 60430.0 * 0.99, 20.0);
}

// 0.61 arcsec/sqrt(s) of 39 uW in 16 cm with a loss of 0.007, by an independent computation, and 0.14 of lock-in.
TEST(LaserAgreement, the_walk_of_quantum_noise_is_taken) {
    const rig::LaserAgreement made = rig::agreed_with_laser(laser({}));
    EXPECT_NEAR(made.config.drift.random_walk_arcsec_sqrt_s, std::hypot(0.61, 0.14), 0.01);
}

// Unequal isotopes make the two sides unlike, and the bias is largest beside where the loop settles.
TEST(LaserAgreement, the_centre_of_unequal_isotopes_is_taken_with_the_points) {
    for (const char* share : {"laser.upper_isotope_ratio=0.535", "laser.upper_isotope_ratio=0.47"}) {
        const config::Config c = laser({share});
        const config::Config calibrated = rig::calibrated_by_laser(c);
        ASSERT_NE(calibrated.perimeter.discriminator_centre_lambda, 0.0);
        const rig::LaserAgreement made = rig::agreed_with_laser(c);
        EXPECT_EQ(made.config.perimeter.discriminator_signal, calibrated.perimeter.discriminator_signal);
        EXPECT_EQ(made.config.perimeter.discriminator_centre_lambda, calibrated.perimeter.discriminator_centre_lambda);
        zlg::test::expect_contains(all(made.notes), "perimeter.discriminator_centre_lambda = ");
        EXPECT_TRUE(made.warnings.empty()) << all(made.warnings);
        // A calibrated processor of the same laser has nothing to take, and one that lacks the centre alone gets it.
        EXPECT_TRUE(rig::agreed_with_laser(calibrated).notes.empty());
        config::Config without = calibrated;
        without.perimeter.discriminator_centre_lambda = 0.0;
        EXPECT_EQ(rig::agreed_with_laser(without).config.perimeter.discriminator_centre_lambda,
                  calibrated.perimeter.discriminator_centre_lambda);
    }
}

TEST(LaserAgreement, a_centre_that_is_given_and_wrong_is_a_contradiction) {
    const rig::LaserAgreement made =
        rig::agreed_with_laser(laser({"laser.upper_isotope_ratio=0.535", "perimeter.discriminator_centre_lambda=0"}));
    EXPECT_NE(all(made.warnings).find("perimeter.discriminator_centre_lambda = 0 is presumed, [laser] makes "),
              std::string::npos)
        << all(made.warnings);
    EXPECT_EQ(made.config.perimeter.discriminator_centre_lambda, 0.0);
}

TEST(LaserAgreement, of_an_averaged_gyro_nothing_is_taken) {
    EXPECT_TRUE(rig::agreed_with_laser({}).warnings.empty());
    EXPECT_EQ(config::to_toml(rig::agreed_with_laser({}).config), config::to_toml({}));
}

}  // namespace zlg::laser_agreement_test
