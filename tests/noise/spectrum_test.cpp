#include <zlg/deviations/series.hpp>
#include <zlg/noise/spectrum.hpp>

#include "simulated_noise.hpp"

namespace zlg::noise::spectrum_test {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

double mean_density(const Spectrum& s, double from_hz, double to_hz) {
    double sum = 0.0;
    int n = 0;
    for (std::size_t k = 0; k < s.density.size(); ++k)
        if (s.frequency_hz[k] >= from_hz && s.frequency_hz[k] < to_hz) sum += s.density[k], ++n;
    return sum / n;
}

TEST(Spectrum, of_white_noise_is_flat_at_twice_its_square) {
    SimulatedNoise gyro(1 << 15, 50.0, 1);
    gyro.add_white(0.7);
    const Spectrum s = welch_spectrum(gyro.rates, 50.0, 1024);
    EXPECT_EQ(s.pieces, 63u);
    EXPECT_EQ(s.density.size(), 512u);
    EXPECT_DOUBLE_EQ(s.frequency_hz.back(), 25.0);
    EXPECT_NEAR(mean_density(s, 1.0, 24.0), 2.0 * 0.49, 0.03);
}

TEST(Spectrum, gaps_change_neither_its_level_nor_a_line) {
    SimulatedNoise gyro(1 << 15, 50.0, 2);
    gyro.add_white(0.7);
    gyro.add_sine(10.0, 50.0 * 128.0 / 1024.0);
    for (std::size_t k = 0; k < gyro.rates.size(); ++k)
        if ((k / 37) % 5 == 0) gyro.rates[k] = not_known;
    const Spectrum s = welch_spectrum(gyro.rates, 50.0, 1024);
    std::size_t peak = 0;
    for (std::size_t k = 0; k < s.density.size(); ++k)
        if (s.density[k] > s.density[peak]) peak = k;
    EXPECT_NEAR(s.frequency_hz[peak], 6.25, 1e-9);
    // A line of amplitude A under a Hann window: A^2/2 T/1.5 at its bin, less what is missing.
    EXPECT_NEAR(s.density[peak], 50.0 * 0.8 * 1024.0 / 50.0 / 1.5, 0.1 * s.density[peak]);
}

TEST(Spectrum, refuses_what_has_none) {
    const std::vector<double> few(7, 1.0), unknown(100, not_known);
    EXPECT_THROW((void)welch_spectrum(few, 1.0, 8), deviations::SeriesError);
    EXPECT_THROW((void)welch_spectrum(unknown, 1.0, 16), deviations::SeriesError);
    EXPECT_THROW((void)welch_spectrum(std::vector<double>(100, 1.0), 0.0, 16), deviations::SeriesError);
}

}  // namespace zlg::noise::spectrum_test
