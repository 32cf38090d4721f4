// Photodiodes of the two beams that differ, and light that falls, in both fidelities.

#include "laser_gyro.hpp"

namespace zlg::twin::beam_photodiodes_test {

constexpr double half_s = 0.0025;

// The perimeter is off its centre for a while, so that the beams differ.
std::vector<TwinHalf> moved(TwinConfig config, const LightConfig& light, int n_halves) {
    config.light = light;
    Twin twin{config, Motion::rest()};
    std::vector<TwinHalf> halves;
    for (int h = 0; h < n_halves; ++h) halves.push_back(twin.advance(frame(true, 1, h % 20 < 10 ? 150.0 : 154.0)));
    return halves;
}

std::vector<TwinConfig> both_fidelities() { return {held_gyro(), as_laser(held_gyro())}; }

//   A' = A p + 1000 offset_a,  B' = B p gain_b (1 + drift t) + 1000 offset_b,  p = exp(-decay t),  t in the middle of
//   the half
TEST(BeamPhotodiodes, MakeOfEverySampleWhatTheirLawSays) {
    const LightConfig light{
        .gain_b = 0.7, .gain_drift_per_h = 400.0, .offset_a = 0.02, .offset_b = -0.03, .power_decay_per_h = 900.0};
    for (const TwinConfig& config : both_fidelities()) {
        const auto plain = moved(config, equal_light, 100);
        const auto seen = moved(config, light, 100);
        for (std::size_t h = 0; h < plain.size(); ++h) {
            const double hours = (static_cast<double>(h) + 0.5) * half_s / 3600.0;
            const double power = std::exp(-900.0 * hours);
            for (std::size_t k = 0; k < 16; ++k) {
                const double a = plain[h].sensor.light_a[k], b = plain[h].sensor.light_b[k];
                EXPECT_NEAR(seen[h].sensor.light_a[k], a * power + 20.0, 1e-3) << h << ' ' << k;
                EXPECT_NEAR(seen[h].sensor.light_b[k], b * power * 0.7 * (1.0 + 400.0 * hours) - 30.0, 1e-3) << h;
            }
            EXPECT_EQ(seen[h].sensor.counter, plain[h].sensor.counter) << "the counter reads the beat";
        }
    }
}

TEST(BeamPhotodiodes, ShowNoLessThanNoLight) {
    for (const TwinConfig& config : both_fidelities()) {
        for (const TwinHalf& half : moved(config, {.gain_drift_per_h = -1e6, .offset_a = -2.0}, 40)) {
            for (std::size_t k = 0; k < 16; ++k) EXPECT_EQ(half.sensor.light_a[k], 0.0f);
            for (std::size_t k = 0; k < 16; ++k) EXPECT_GE(half.sensor.light_b[k], 0.0f);
        }
    }
}

TEST(BeamPhotodiodes, OfEqualBeamsChangeNoBit) {
    for (TwinConfig config : both_fidelities()) {
        config.gyro.light_noise_lambda = 0.0033;
        config.gyro.readout = Readout::phase;
        const auto neutral = moved(config, {1.0, 0.0, 0.0, 0.0, 0.0}, 40);
        const auto plain = moved(config, equal_light, 40);
        for (std::size_t h = 0; h < plain.size(); ++h) {
            EXPECT_EQ(plain[h].sensor.light_a, neutral[h].sensor.light_a);
            EXPECT_EQ(plain[h].sensor.light_b, neutral[h].sensor.light_b);
            EXPECT_EQ(plain[h].sensor.fringe_c, neutral[h].sensor.fringe_c);
        }
    }
}

// The beat of two beams that both have the power p has the amplitude p.
TEST(BeamPhotodiodes, TheBeatFallsWithThePowerAndNotWithTheGains) {
    for (TwinConfig config : both_fidelities()) {
        config.gyro.readout = Readout::phase;
        config.photodiodes = {.offset_cosine = 0.0,
                              .offset_sine = 0.0,
                              .amplitude_error = 0.0,
                              .angle_error_deg = 0.0,
                              .noise = 0.0,
                              .adc_bits = 24};
        const auto plain = moved(config, equal_light, 100);
        const auto seen = moved(config, {.gain_b = 0.5, .offset_b = 0.1, .power_decay_per_h = 7200.0}, 100);
        for (std::size_t h = 0; h < plain.size(); ++h) {
            const double power = std::exp(-2.0 * static_cast<double>(h + 1) * half_s);  // the latch ends the half
            EXPECT_NEAR(seen[h].sensor.fringe_c, power * plain[h].sensor.fringe_c, 1e-6) << h;
            EXPECT_NEAR(seen[h].sensor.fringe_s, power * plain[h].sensor.fringe_s, 1e-6) << h;
        }
    }
}

}  // namespace zlg::twin::beam_photodiodes_test
