#include <zlg/core/compensation/compensation_constants.hpp>

#include "compensation_support.hpp"

namespace zlg::core::compensation_constants_test {

using namespace compensation_test;
using Constants = CompensationConstants;
using Fault = GyroCompensationFault;

constexpr Fault with(auto change) { return test::fault_of<Constants>(change); }

void expect_fault(Fault fault, const std::function<void(Constants&, double)>& set, std::initializer_list<double> bad) {
    for (const double value : bad) {
        EXPECT_EQ(with([&](Constants& g) { set(g, value); }), fault) << static_cast<int>(fault) << ' ' << value;
    }
}

TEST(CompensationConstants, CheckAcceptsTheDefaultsAndTheEdges) {
    EXPECT_EQ(check(Constants{}), Fault::none);
    EXPECT_EQ(check(Constants{.random_walk = ArcsecPerRootSecond{0.0},
                              .bias = Hertz{1e12},
                              .chi = -1e6,
                              .temperature_coefficient_per_c = -1.0,
                              .light_noise = Wavelengths{0.0},
                              .light_samples = 1}),
              Fault::none);
}

TEST(CompensationConstants, CheckNamesTheFirstBadField) {
    const double nan = not_a_number;
    const double inf = infinite;
    expect_fault(Fault::relock, [](auto& g, double x) { g.tick = Seconds{x}; }, {0.0, -0.005, 1e300, 1e-300, nan, inf});
    expect_fault(Fault::relock, [](auto& g, double x) { g.scale = Arcsec{x}; }, {0.0, -3.0, 1e300, nan, inf});
    expect_fault(Fault::random_walk, [](auto& g, double x) { g.random_walk = ArcsecPerRootSecond{x}; },
                 {-0.1, 1.1e6, nan, inf});
    expect_fault(Fault::relock, [](auto& g, double x) { g.bias = Hertz{x}; }, {0.0, -60e3, 1e300, nan, inf});
    expect_fault(Fault::relock, [](auto& g, double x) { g.chi = x; }, {-1.1e6, 1.1e6, nan, inf});
    for (std::size_t k = 0; k < 3; ++k)
        expect_fault(Fault::relock, [k](auto& g, double x) { g.bend.term[k] = x; }, {-1.1e15, 1.1e15, nan, inf});
    expect_fault(Fault::relock, [](auto& g, double x) { g.temperature_coefficient_per_c = x; },
                 {-1.1, 1.1, nan, inf, -inf});
    expect_fault(Fault::relock, [](auto& g, double x) { g.reference_temperature = Celsius{x}; },
                 {-1.1e6, 1.1e6, nan, inf, -inf});
    expect_fault(Fault::relock, [](auto& g, double x) { g.centre = Wavelengths{x}; }, {-1.1, 1.1, nan});
    expect_fault(Fault::edges, [](auto& g, double x) { g.timer = Hertz{x}; }, {0.5, 2e15, nan});
    expect_fault(Fault::edges, [](auto& g, double x) { g.plateau_ratio = x; }, {0.99, 2.01, nan});
    expect_fault(Fault::relock, [](auto& g, double x) { g.light_noise = Wavelengths{x}; }, {-0.1, 10.1, nan, inf});
    expect_fault(Fault::relock, [](auto& g, double x) { g.light_samples = static_cast<int>(x); }, {0.0, -1.0});
    expect_fault(Fault::relock, [](auto& g, double x) { g.record_curve.n_nodes = static_cast<int>(x); }, {-1.0, 40.0});
    expect_fault(Fault::relock, [](auto& g, double x) { g.control_curve.n_nodes = static_cast<int>(x); }, {-1.0, 40.0});
}

// Sums of ticks with wilder numbers than these leave the range of a double.
TEST(CompensationConstants, CheckRefusesNumbersWithWhichNoSumIsANumber) {
    const auto expect_ends = [&](auto set, double least, double most, Fault fault) {
        EXPECT_EQ(with([&](auto& g) { set(g, least); }), Fault::none);
        EXPECT_EQ(with([&](auto& g) { set(g, most); }), Fault::none);
        EXPECT_EQ(with([&](auto& g) { set(g, std::nextafter(least, 0.0)); }), fault);
        EXPECT_EQ(with([&](auto& g) { set(g, std::nextafter(most, infinite)); }), fault);
    };
    expect_ends([](auto& g, double x) { g.tick = Seconds{x}; }, 1e-9, 1e9, Fault::relock);
    expect_ends([](auto& g, double x) { g.scale = Arcsec{x}; }, 1e-9, 1e9, Fault::relock);
    expect_ends([](auto& g, double x) { g.bias = Hertz{x}; }, 5e-324, 1e15, Fault::relock);
}

TEST(CompensationConstants, TheBiasFollowsTheTemperature) {
    const Constants gyro{
        .bias = Hertz{60e3}, .temperature_coefficient_per_c = -1e-4, .reference_temperature = Celsius{25.0}};
    EXPECT_EQ(bias_at(gyro, Celsius{25.0}).value(), 60e3);
    EXPECT_NEAR(bias_at(gyro, Celsius{35.0}).value(), 60e3 * 0.999, 1e-9);
    for (const double none : {not_a_number, infinite, -1.1e6, 1.7e308})
        EXPECT_EQ(bias_at(gyro, Celsius{none}).value(), 60e3) << none;
}

// Two groups at 0.15 +- 0.05 with noise of 0.01 and a centre of 0.02: b x^4 is the mean of b 0.18^4 and b 0.08^4.
TEST(CompensationConstants, TermsBeyondTheSquareAreMeansOverTwoGroups) {
    const double mean_sq = 0.5 * (0.2 * 0.2 + 0.1 * 0.1) + 0.01 * 0.01;
    for (unsigned k = 0; k < 3; ++k) {
        Constants g{.centre = Wavelengths{0.02}, .light_noise = Wavelengths{0.01}};
        g.bend.term[k] = -7.0;
        const double expected = -3.5 * (std::pow(0.18, 4 + 2 * k) + std::pow(0.08, 4 + 2 * k));
        EXPECT_NEAR(beyond_square(g, {.mean_lambda = 0.15, .mean_sq_lambda2 = mean_sq}), expected, 1e-15);
        EXPECT_DOUBLE_EQ(most_loss(g.bend, 0.04), 0.04 + 7.0 * std::pow(0.04, 2 + k));
    }
    EXPECT_EQ(beyond_square(Constants{}, {.mean_lambda = 0.1, .mean_sq_lambda2 = 0.02}), 0.0);
}

}  // namespace zlg::core::compensation_constants_test
