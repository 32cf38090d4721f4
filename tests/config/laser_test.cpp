#include <gtest/gtest.h>

#include <zlg/config/config.hpp>

using namespace zlg::config;

// A ring of 0.16 m; wavelength 632.8 nm; neon at 400 K, of which half is neon 22; a field of 15 G.
TEST(Laser, the_defaults_are_a_gas_of_equal_isotopes_little_above_threshold) {
    const Laser laser;
    EXPECT_EQ(laser.perimeter_m, 0.160);
    EXPECT_EQ(laser.round_trip_loss_ratio, 0.007);
    EXPECT_EQ(laser.gain_loss_ratio, 1.20);
    EXPECT_EQ(laser.homogeneous_half_width_hz, 130e6);
    EXPECT_EQ(laser.isotope_shift_hz, 2.0 * 442.5e6);
    EXPECT_EQ(laser.upper_isotope_ratio, 0.5);
    EXPECT_EQ(laser.zeeman_hz_per_g, 1.82e6);
    EXPECT_EQ(laser.opposite_sigma_coupling, 0.6);
    EXPECT_EQ(laser.bias_field_g, 15.0);
    EXPECT_EQ(laser.quadrature, Quadrature::x1);

    // Most probable speed sqrt(2 k T/m) of 21 atomic mass units at 400 K, over the wavelength.
    const double speed_m_s = 562.8;
    EXPECT_NEAR(laser.doppler_half_width_hz, speed_m_s / 632.8e-9, 0.03 * laser.doppler_half_width_hz);
}
