#include "mean_error.hpp"

#include <boost/math/distributions/students_t.hpp>

#include "records.hpp"

namespace zlg::mean_error_test {

using namespace acceptance_test;
using acceptance::mean_error;
using acceptance::MeanError;

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

Score score(const std::function<Series(std::uint64_t)>& draw) {
    constexpr int trials = 400;
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

// Slow noise that hardly shows makes the error of a mean too small by sixteen where it is taken for none; to the
// average gyro the error has to be as stated, and verdicts must keep their risk of 5 % with each.
TEST(MeanError, covers_slow_noise_that_does_not_show) {
    std::map<std::string, Score> scores{{"white", score([](std::uint64_t k) { return with_walk(0.0, k); })},
                                        {"flicker", score([](std::uint64_t k) { return with_flicker(n / 16.0, k); })}};
    for (const int part : {2, 8, 16, 64})
        scores[fmt::format("walk that crosses at 1/{}", part)] =
            score([part](std::uint64_t k) { return with_walk(static_cast<double>(n) / part, k); });
    double mean = 0.0;
    for (const auto& [name, s] : scores) {
        mean += s.squares / static_cast<double>(scores.size());
        EXPECT_LT(s.squares, 3.0) << name;
        EXPECT_GT(s.squares, 0.15) << name;
        // Four deviations of the count of 400 above a risk of 5 %, of two sides.
        EXPECT_LT(s.beyond, 0.05 + 4.0 * std::sqrt(0.05 * 0.95 / 400.0 / 2.0)) << name;
    }
    EXPECT_GT(mean, 0.7);
    EXPECT_LT(mean, 1.4);
}

// (k^2 modulo 17) + slope k: by numpy and scipy.fft.dct, with the same laws.
TEST(MeanError, is_that_of_an_independent_computation) {
    const auto of = [](int count, double slope) {
        Series x;
        for (int k = 0; k < count; ++k) x.push_back(k * k % 17 + slope * k);
        return mean_error(x);
    };
    const auto expect = [](const MeanError& e, double sigma, double degrees) {
        EXPECT_NEAR(e.sigma, sigma, 1e-9 * sigma);
        EXPECT_NEAR(e.degrees, degrees, 1e-8 * degrees);
    };
    expect(of(64, 0.0), 2.98305217979062, 4.236281132207462);
    expect(of(64, 1.0), 21.21645272426268, 9.317561611883827);
    expect(of(20, 0.0), 9.117279070715863, 4.583830399202488);
}

TEST(MeanError, follows_the_unit_and_not_the_bias_and_takes_gaps_and_sinusoids) {
    Series x = white(640, 1.0), scaled = x, holed = x, wavy = x;
    for (double& one : scaled) one = 1e6 + 1e3 * one;
    for (std::size_t k = 0; k < x.size(); k += 7) holed[k] = NAN;
    for (std::size_t k = 0; k < x.size(); ++k)
        wavy[k] += 5.0 * std::sin(2.0 * 3.14159265358979 * 6.0 * static_cast<double>(k) / 640.0);
    const MeanError e = mean_error(x);
    EXPECT_NEAR(mean_error(scaled).sigma, 1e3 * e.sigma, 1e-5 * 1e3 * e.sigma);
    EXPECT_NEAR(mean_error(holed).sigma, e.sigma, 0.3 * e.sigma);
    EXPECT_GT(mean_error(wavy).sigma, 3.0 * e.sigma);
    EXPECT_NEAR(mean_error(wavy, std::vector<double>{12.0}).sigma, e.sigma, 0.3 * e.sigma);
}

TEST(MeanError, of_few_or_equal_means_is_not_known) {
    EXPECT_EQ(mean_error(white(7, 1.0)).sigma, INFINITY);
    EXPECT_EQ(mean_error(Series(100, 3.0)).sigma, INFINITY);
    EXPECT_LT(mean_error(white(8, 1.0)).sigma, INFINITY);
}

// Every second record walks, and crosses its white noise at 1/16 of the record.
TEST(MeanError, is_that_of_the_bias_in_the_report) {
    constexpr int trials = 24;
    double squares = 0.0;
    for (std::uint64_t k = 1; k <= trials; ++k) {
        Series rates = with_walk(k % 2 == 0 ? n / 16.0 : 0.0, k);
        const double next = mean_of(&rates[n]);
        rates.resize(n);
        write("mean.csv", {rates});
        const auto test = accepted(run("static", "mean.csv"));
        const acceptance::Value bias = of(test, "bias.deg_h").value;
        squares += 0.5 * std::pow((bias.value - next) / bias.uncertainty, 2) / trials;
    }
    EXPECT_LT(squares, 3.0);
}

}  // namespace zlg::mean_error_test
