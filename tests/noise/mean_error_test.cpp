#include <zlg/noise/mean_error.hpp>

#include <boost/math/distributions/students_t.hpp>

#include <zlg/chance/draw.hpp>

#include "test.hpp"

namespace zlg::noise::mean_error_test {

constexpr std::size_t n = 1024;

// Two records, one after the other, of white noise of variance 1 and slow noise.
using Series = std::vector<double>;

Series with_walk(double crossing, std::uint64_t seed) {
    chance::Draw draw{seed, chance::Cause::test};
    const double step = crossing > 0.0 ? std::sqrt(3.0) / crossing : 0.0;
    Series rates(2 * n);
    double walk = 0.0;
    for (double& rate : rates) rate = (walk += step * draw.normal()) + draw.normal();
    return rates;
}

// Markov noises an octave apart in time, of variance s^2 each: B^2/(2 pi f) with B^2 = pi s^2/ln2, so that the floor
// 2 ln2/pi B^2 is 2 s^2.
Series with_flicker(double crossing, std::uint64_t seed) {
    chance::Draw draw{seed, chance::Cause::test};
    Series rates(2 * n);
    for (double& rate : rates) rate = draw.normal();
    for (double time = 1.0; time < 256.0 * n; time *= 2.0) {
        const double kept = std::exp(-1.0 / time), s = std::sqrt(0.5 / crossing);
        double slow = s * draw.normal();
        for (double& rate : rates) rate += slow = kept * slow + s * std::sqrt(1.0 - kept * kept) * draw.normal();
    }
    return rates;
}

double mean_of(const double* from) {
    double sum = 0.0;
    for (std::size_t k = 0; k < n; ++k) sum += from[k];
    return sum / n;
}

struct Score {
    double squares = 0.0, beyond = 0.0;  // means of (error/sigma)^2, and of errors above the 95 % quantile
};

constexpr int trials = 400;

Score score(const std::function<Series(std::uint64_t)>& draw) {
    Score s;
    for (std::uint64_t k = 1; k <= trials; ++k) {
        const Series rates = draw(k);
        const MeanError e = mean_error(std::span{rates}.first(n));
        const double off = (mean_of(&rates[n]) - mean_of(rates.data())) / std::sqrt(2.0) / e.sigma;
        const double bound = boost::math::quantile(boost::math::students_t(e.degrees), 0.95);
        s.squares += off * off / trials;
        s.beyond += (std::abs(off) > bound ? 0.5 : 0.0) / trials;
    }
    return s;
}

// Slow noise that hardly shows makes the error of a mean too small by up to sixteen where it is taken for none. Both
// bounds count: a sigma half as large or twice as large is found.
TEST(MeanError, covers_slow_noise_that_does_not_show) {
    // By another program, of three times 4000 such series from other random numbers: the mean square, its standard
    // deviation for 400 series, and the part beyond.
    struct Measured {
        double part, squares, deviation, beyond;  // of the record, at which slow noise crosses; negative: flicker
    };
    for (const Measured& m :
         {Measured{0.0, 0.32, 0.03, 0.001}, Measured{2.0, 1.18, 0.10, 0.031}, Measured{8.0, 2.85, 0.37, 0.077},
          Measured{16.0, 2.24, 0.34, 0.067}, Measured{64.0, 1.15, 0.11, 0.047}, Measured{-16.0, 0.72, 0.09, 0.016}}) {
        const Score s = score([&m](std::uint64_t k) {
            return m.part < 0.0 ? with_flicker(n / -m.part, k) : with_walk(m.part > 0.0 ? n / m.part : 0.0, k);
        });
        EXPECT_NEAR(s.squares, m.squares, 3.0 * m.deviation) << m.part;
        EXPECT_LT(s.beyond, m.beyond + 3.0 * std::sqrt(0.5 * m.beyond / trials) + 0.5 / trials) << m.part;
    }
}

// (k^2 modulo 17) + slope k: by numpy and scipy.fft.dct, with the same laws.
TEST(MeanError, is_that_of_an_independent_computation) {
    const auto of = [](int count, double slope, const Series& lines = {}) {
        Series x;
        for (int k = 0; k < count; ++k) x.push_back(k * k % 17 + slope * k);
        return mean_error(x, lines);
    };
    const auto expect = [](const MeanError& e, double sigma, double degrees) {
        EXPECT_NEAR(e.sigma, sigma, 1e-9 * sigma);
        EXPECT_NEAR(e.degrees, degrees, 1e-8 * degrees);
    };
    expect(of(64, 0.0), 2.932674511035633, 4.278707012914086);
    expect(of(64, 1.0), 20.63741529404831, 11.122291207238163);
    expect(of(20, 0.0), 6.386193208243554, 4.502104664653947);
    expect(of(64, 0.0, {12.0}), 3.3256036478597077, 4.23947039166791);
}

TEST(MeanError, follows_the_unit_and_not_the_bias_and_takes_gaps_and_sinusoids) {
    Series x = with_walk(0.0, 1);
    x.resize(640);
    Series scaled = x, holed = x, wavy = x;
    for (double& one : scaled) one = 1e6 + 1e3 * one;
    for (std::size_t k = 0; k < x.size(); k += 7) holed[k] = NAN;
    for (std::size_t k = 0; k < x.size(); ++k)
        wavy[k] += 5.0 * std::cos(3.14159265358979 * 12.0 * (static_cast<double>(k) + 0.5) / 640.0);
    const MeanError e = mean_error(x);
    EXPECT_NEAR(mean_error(scaled).sigma, 1e3 * e.sigma, 1e-5 * 1e3 * e.sigma);
    EXPECT_NEAR(mean_error(holed).sigma, e.sigma, 0.3 * e.sigma);
    EXPECT_GT(mean_error(wavy).sigma, 3.0 * e.sigma);
    // The wave is one mode of the spectrum, and beside it nothing is left of it.
    const Series line{12.0};
    EXPECT_NEAR(mean_error(wavy, line).sigma, mean_error(x, line).sigma, 1e-9 * e.sigma);
}

// A record of white noise is more often so than not; of one 16 times as long as a walk needs to show, hardly ever.
TEST(MeanError, white_noise_is_told_from_a_walk) {
    int white = 0, walk = 0;
    for (std::uint64_t k = 1; k <= 200; ++k) {
        const Series flat = with_walk(0.0, k), walking = with_walk(n / 16.0, k);
        white += mean_error(std::span{flat}.first(n)).white > 0.5 ? 1 : 0;
        walk += mean_error(std::span{walking}.first(n)).white > 0.5 ? 1 : 0;
    }
    EXPECT_GT(white, 140);
    EXPECT_LT(walk, 4);
}

// Where one in ten is known beside stretches without a gap.
TEST(MeanError, stretches_with_hardly_anything_known_do_not_count) {
    Series x = with_walk(0.0, 2);
    x.resize(640);
    for (std::size_t k = 100; k < 110; ++k) x[k] = k == 100 ? 1000.0 : NAN;
    Series without = x;
    without[100] = NAN;
    EXPECT_EQ(mean_error(x).sigma, mean_error(without).sigma);
    // A record of which so much is known throughout has nothing else.
    for (std::size_t k = 0; k < x.size(); ++k)
        if (k % 10 != 0) x[k] = NAN;
    EXPECT_GT(mean_error(x).sigma, 0.0);
}

TEST(MeanError, of_few_or_equal_means_is_not_known) {
    Series x = with_walk(0.0, 3);
    x.resize(8);
    EXPECT_GT(mean_error(x).sigma, 0.0);
    x.pop_back();
    EXPECT_TRUE(std::isnan(mean_error(x).sigma));
    EXPECT_TRUE(std::isnan(mean_error(Series(100, 3.0)).sigma));
    EXPECT_TRUE(std::isnan(mean_error(Series(100, NAN)).sigma));
    EXPECT_TRUE(std::isnan(mean_error({}).sigma));
}

}  // namespace zlg::noise::mean_error_test
