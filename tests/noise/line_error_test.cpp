#include <zlg/noise/line_error.hpp>

#include <boost/math/distributions/students_t.hpp>

#include <zlg/chance/draw.hpp>

#include "test.hpp"

namespace zlg::noise::line_error_test {

constexpr std::size_t n = 41;

// Stages from -1 to 1, in order or mixed.
std::vector<double> rates_of(bool mixed) {
    std::vector<double> rates(n);
    for (std::size_t k = 0; k < n; ++k) rates[k] = static_cast<double>((mixed ? 8 : 1) * k % n) / 20.0 - 1.0;
    return rates;
}

double slope_of(const std::vector<double>& x, const std::vector<double>& y) {
    double xx = 0.0, xy = 0.0;  // the mean of x is 0
    for (std::size_t k = 0; k < n; ++k) xx += x[k] * x[k], xy += x[k] * y[k];
    return xy / xx;
}

struct Score {
    double squares = 0.0, beyond = 0.0, inverse_degrees = 0.0;  // means; beyond 95 % on either side
};

// Of a truth of 0, white noise of 1 and a walk.
Score score(double step, bool mixed) {
    constexpr int trials = 400;
    const boost::math::students_t law(n - 2.0);
    Score s;
    for (std::uint64_t k = 1; k <= trials; ++k) {
        chance::Draw draw{k, chance::Cause::test};
        std::vector<double> x = rates_of(mixed), y(n);
        double walk = 0.0;
        for (double& each : y) each = (walk += step * draw.normal()) + draw.normal();
        const LineError e = line_error(x, y);
        const double off = std::abs(slope_of(x, y)) / e.slope_sigma;
        s.squares += off * off / trials;
        s.beyond += (off > boost::math::quantile(law, 0.975) ? 1.0 : 0.0) / trials;
        s.inverse_degrees += 1.0 / e.degrees / trials;
    }
    return s;
}

// With independent errors the mean square of 41 stages is 39/37. By numpy, 4000 tables: 1.04; the step over the white
// noise of a stage is that of a walk that crosses at 256 s, of stages of 32 s each.
TEST(LineError, keeps_its_error_where_the_rates_are_mixed) {
    for (const double step : {0.0, 0.2165, 0.866}) {
        const Score s = score(step, true);
        EXPECT_NEAR(s.squares, 39.0 / 37.0, 0.25) << step;
        EXPECT_NEAR(s.beyond, 0.05, 0.04) << step;
    }
}

// By numpy, 4000 tables each: 0.29, 1.51 and 1.53, and 0.002, 0.103 and 0.074 beyond, where the error of ordinary least
// squares gives 1.07, 8.2 and 46, and 0.05, 0.48 and 0.76.
TEST(LineError, counts_a_walk_that_looks_like_a_slope) {
    for (const auto& [step, squares, beyond] :
         {std::array{0.0, 0.29, 0.002}, {0.2165, 1.51, 0.103}, {0.866, 1.53, 0.074}}) {
        const Score s = score(step, false);
        EXPECT_NEAR(s.squares / squares, 1.0, 0.35) << step;
        EXPECT_NEAR(s.beyond, beyond, 0.04) << step;
    }
}

// Satterthwaite's (tr C)^2/tr C^2: of independent stages n - 2, at the most, of a walk without its mean, whose modes
// have variances as 1/k^2, (pi^2/6)^2/(pi^4/90) = 2.5.
TEST(LineError, knows_how_little_the_scatter_of_a_walk_tells) {
    const Score white = score(0.0, false), walk = score(100.0, true);
    EXPECT_LE(1.0 / white.inverse_degrees, 39.0);
    EXPECT_GT(1.0 / white.inverse_degrees, 33.0);  // a walk may be there
    EXPECT_NEAR(1.0 / walk.inverse_degrees, 2.5, 0.4);
}

TEST(LineError, is_in_the_units_of_output_over_input) {
    std::vector<double> x = rates_of(false), y(n);
    chance::Draw draw{7, chance::Cause::test};
    for (double& each : y) each = draw.normal();
    const LineError one = line_error(x, y);
    for (double& each : x) each *= 36000.0;
    for (double& each : y) each *= 5.0;
    const LineError other = line_error(x, y);
    EXPECT_NEAR(other.slope_sigma / one.slope_sigma, 5.0 / 36000.0, 1e-9);
    EXPECT_NEAR(other.degrees, one.degrees, 1e-6);
}

}  // namespace zlg::noise::line_error_test
