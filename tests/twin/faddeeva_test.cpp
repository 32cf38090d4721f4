#include <laser/faddeeva.hpp>

#include "test.hpp"

namespace zlg::twin::faddeeva_test {

using Complex = std::complex<double>;

struct Value {
    double x, y, re, im;
};

// exp(-z^2) erfc(-i z) by mpmath with 40 digits. The places lie in every region of the method, and on the borders
// where it exchanges its rules.
constexpr Value values[] = {
    {0.0, 0.1433, 0.85681854069106226, 0.0},
    {0.488, 0.1433, 0.70021709260349045, 0.37543469455607334},
    {0.2558, 0.1, 0.84556849418744226, 0.23331391019557181},
    {0.5117, 0.02, 0.75717036437465922, 0.47097909750599355},
    {0.7675, 0.02, 0.55048669820685843, 0.57744245177244077},
    {1.5, 0.1433, 0.14447254292086184, 0.4383455082007344},
    {3.0, 0.01, 0.0009088307067415805, 0.2011464625401964},
    {6.2, 0.1433, 0.0021899052674297991, 0.092178667169634229},
    {12.0, 0.3, 0.0011870959561778176, 0.047150784526348904},
    {0.3, 3.0, 0.17758140381831553, 0.01619151642349221},
    {2.0, 2.0, 0.14795275951201582, 0.13117971708421785},
    {5.0, 6.5, 0.054717547606310835, 0.041474165413339146},
    {1.0, 20.0, 0.028104521704702714, 0.0014017433440084846},
    {100.0, 0.5, 2.821300608535616e-5, 0.0056420368863968999},
    {0.25, 0.0, 0.93941306281347579, 0.27062951561798749},
    {4.0, 1e-8, 1.1292767024031586e-7, 0.14595358990014378},
};

TEST(Faddeeva, AgreesWithFortyDigits) {
    for (const Value& v : values) {
        const Complex w = faddeeva({v.x, v.y});
        const Complex expected{v.re, v.im};
        EXPECT_LE(std::abs(w - expected), 1e-14 * std::abs(expected)) << v.x << " + " << v.y << " i";
    }
}

TEST(Faddeeva, MirrorsAtTheImaginaryAxis) {
    for (const Value& v : values) {
        EXPECT_EQ(faddeeva({-v.x, v.y}), std::conj(faddeeva({v.x, v.y})));
    }
}

TEST(Faddeeva, OnTheImaginaryAxisIsTheScaledErrorFunction) {
    for (double y = 0.0; y < 5.0; y += 0.07) {
        const Complex w = faddeeva({0.0, y});
        EXPECT_NEAR(w.real(), std::exp(y * y) * std::erfc(y), 1e-14) << y;
        EXPECT_EQ(w.imag(), 0.0);
    }
}

TEST(Faddeeva, OnTheRealAxisHasAGaussianRealPart) {
    for (double x = 0.0; x < 7.0; x += 0.0137) {
        EXPECT_NEAR(faddeeva({x, 0.0}).real(), std::exp(-x * x), 4e-15) << x;
    }
}

// A node of either rule right beside Re z would cancel against the residue; the other rule must have been taken.
TEST(Faddeeva, NoNodeComesTooNearToThePole) {
    const double step = std::sqrt(std::numbers::pi / 12.0);
    for (int half_steps = 1; half_steps < 14; ++half_steps) {
        for (const double off : {-1e-3, -1e-9, 0.0, 1e-9, 1e-3}) {
            const double x = 0.5 * half_steps * step + off;
            EXPECT_NEAR(faddeeva({x, 0.0}).real(), std::exp(-x * x), 4e-15) << x;
        }
    }
}

// w' = -2 z w + 2 i/sqrt(pi) with a central difference, across every border between rules.
TEST(Faddeeva, ObeysItsDifferentialEquation) {
    constexpr double h = 1e-3;
    for (double y = 0.0; y < 7.0; y += 0.173) {
        for (double x = -7.0; x < 7.0; x += 0.0731) {
            const auto at = [&](double d) { return faddeeva({x + d, y}); };
            const Complex slope = (8.0 * (at(h) - at(-h)) - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h);
            const Complex expected = -2.0 * Complex{x, y} * at(0.0) + Complex{0.0, 2.0 * std::numbers::inv_sqrtpi};
            ASSERT_LE(std::abs(slope - expected), 1e-10) << x << " + " << y << " i";
        }
    }
}

struct Slope {
    double x, y, step, re, im;
};

TEST(FaddeevaSlope, AgreesWithFortyDigitsDownToEqualPlaces) {
    constexpr Slope slopes[] = {
        {0.3, 0.1433, 0.0, -0.40418694302221294, 0.75014046750119791},
        {0.3, 0.1433, 1e-9, -0.40418694358713733, 0.75014046708279029},
        {0.3, 0.1433, 1e-4, -0.40424343203532799, 0.75009862311606355},
        {0.3, 0.1433, 0.02, -0.41534682507937504, 0.74162926682325019},
        {0.3, 0.1433, 0.025, -0.41809286137585781, 0.73945752527808849},
        {-1.1, 0.1433, -0.01, 0.54715217404809091, -0.082204289300248315},
        {0.3, 0.1433, 0.7, -0.59994799678022115, 0.3720646258909655},
        {2.0, 0.02, 0.009, -0.076906096014331353, -0.22554153156798759},
        {0.0, 0.1, 0.027, -0.021634484821811382, 0.94866558490417967},
    };
    for (const Slope& s : slopes) {
        const Complex a{s.x, s.y};
        const Complex b{s.x + s.step, s.y};
        const Complex slope = faddeeva_slope(a, faddeeva(a), b, faddeeva(b));
        EXPECT_LE(std::abs(slope - Complex{s.re, s.im}), 1e-13) << s.x << " step " << s.step;
    }
}

}  // namespace zlg::twin::faddeeva_test
