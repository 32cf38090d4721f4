// Claims about bias_temperature: what follows the temperature is found within its errors, and noise that merely is as
// slow passes for none of it.
#include <zlg/noise/bias_temperature.hpp>

#include <zlg/deviations/series.hpp>

#include "simulated_noise.hpp"

namespace zlg::noise {
namespace {

constexpr std::size_t n = 128 * 313;  // it turns from warming to cooling where a stretch ends

// Up from 10 C to 40 C and down again.
std::vector<double> temperatures() {
    std::vector<double> t(n);
    for (std::size_t k = 0; k < n; ++k)
        t[k] = 25.0 - 15.0 * std::cos(2.0 * std::numbers::pi * static_cast<double>(k) / n);
    return t;
}

TEST(BiasTemperature, a_law_of_third_order_with_hysteresis_is_found_exactly) {
    const std::vector<double> t = temperatures();
    std::vector<double> rates(n), input(n);
    for (std::size_t k = 0; k < n; ++k) {
        const double x = t[k] - 25.0, d = k < n / 2 ? 1.0 : -1.0;
        input[k] = k / 100 % 2 == 0 ? 3600.0 : -3600.0;
        rates[k] = 7.0 + 0.3 * x - 0.02 * x * x + 1e-3 * x * x * x + 0.25 * d + input[k] * (1.001 + 2e-5 * x);
    }
    rates[17] = std::numeric_limits<double>::quiet_NaN();
    const BiasTemperature found =
        bias_temperature({.rates_arcsec_s = rates, .temperature_c = t, .input_arcsec_s = input});
    ASSERT_EQ(found.order, 3);
    const std::array<double, 4> bias{7.0, 0.3, -0.02, 1e-3}, within{0.005, 5e-4, 5e-5, 5e-6};
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(found.bias[k].value, bias[k], within[k]) << k;
    EXPECT_NEAR(found.hysteresis_arcsec_s.value, 0.5, 0.01);
    EXPECT_NEAR(found.scale[0].value, 1.001, 1e-5);
    EXPECT_NEAR(found.scale[1].value, 2e-5, 1e-6);
    EXPECT_NEAR(found.drift_arcsec_s(35.0), 3.0 - 2.0 + 1.0, 0.02);
}

TEST(BiasTemperature, errors_are_those_of_many_records_and_a_walk_is_no_temperature) {
    const std::vector<double> t = temperatures();
    double squares = 0.0;
    int n_false = 0, n_hidden = 0;
    constexpr int records = 30;
    for (unsigned seed = 0; seed < records; ++seed) {
        SimulatedNoise with(n, 1.0, seed), without(n, 1.0, 1000 + seed);
        for (SimulatedNoise* noise : {&with, &without}) {
            noise->add_white(1.0);
            noise->add_random_walk(0.003);
        }
        for (std::size_t k = 0; k < n; ++k) with.rates[k] += 0.1 * (t[k] - 25.0);
        const BiasTemperature found = bias_temperature({.rates_arcsec_s = with.rates, .temperature_c = t});
        squares += std::pow((found.bias[1].value - 0.1) / found.bias[1].sigma, 2) / records;
        n_hidden += found.order == 0 ? 1 : 0;
        n_false += bias_temperature({.rates_arcsec_s = without.rates, .temperature_c = t}).order > 0 ? 1 : 0;
    }
    EXPECT_GT(squares, 0.4);
    EXPECT_LT(squares, 1.9);
    EXPECT_LE(n_false, 3);
    EXPECT_EQ(n_hidden, 0);
}

TEST(BiasTemperature, what_does_not_change_is_refused) {
    const std::vector<double> rates(n, 1.0), t(n, 25.0), rising = [] {
        std::vector<double> r(n);
        for (std::size_t k = 0; k < n; ++k) r[k] = static_cast<double>(k);
        return r;
    }();
    EXPECT_THROW((void)bias_temperature({.rates_arcsec_s = rates, .temperature_c = t}), deviations::SeriesError);
    EXPECT_THROW((void)bias_temperature({.rates_arcsec_s = rates, .temperature_c = std::span{t}.first(5)}),
                 deviations::SeriesError);
    EXPECT_FALSE(bias_temperature({.rates_arcsec_s = rising, .temperature_c = rising}).hysteresis_arcsec_s.determined);
}

}  // namespace
}  // namespace zlg::noise
