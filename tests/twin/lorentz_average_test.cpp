#include <laser/lorentz_average.hpp>

#include "quadrature.hpp"

namespace zlg::twin::lorentz_average_test {

double maxwell(double v) { return std::exp(-v * v) * std::numbers::inv_sqrtpi; }

double lorentzian(double v, double centre, double y) { return y * y / (y * y + (v - centre) * (v - centre)); }

template <class F> double averaged(const F& f) {
    return integral([&](double v) { return maxwell(v) * f(v); }, -7.0, 7.0, 1e-13);
}

constexpr double half_widths[] = {0.02, 0.1433, 0.5, 3.0};

TEST(LorentzAverage, LineAgreesWithQuadrature) {
    for (const double y : half_widths) {
        for (const double c : {-1.7, 0.0, 0.012, 0.488, 2.1, 4.0}) {
            EXPECT_NEAR(average_line(Hole{c, y}), averaged([&](double v) { return lorentzian(v, c, y); }), 1e-12);
        }
    }
}

TEST(LorentzAverage, DispersionAgreesWithQuadrature) {
    for (const double y : half_widths) {
        for (const double c : {-1.7, 0.0, 0.012, 0.488, 2.1, 4.0}) {
            const auto dispersion = [&](double v) { return y * (c - v) / (y * y + (v - c) * (v - c)); };
            EXPECT_NEAR(average_dispersion(Hole{c, y}), averaged(dispersion), 1e-12);
        }
    }
}

TEST(LorentzAverage, OverlapAgreesWithQuadratureFromEqualHolesToDistantOnes) {
    for (const double y : half_widths) {
        for (const double a : {-0.9, 0.0, 0.488, 1.9}) {
            for (const double d : {0.0, 1e-13, 1e-8, 1e-4, 0.0101, 0.0202, 0.0301, -0.4, 1.0, -3.0}) {
                const auto overlap = [&](double v) { return lorentzian(v, a, y) * lorentzian(v, a + d, y); };
                EXPECT_NEAR(average_overlap(Hole{a, y}, Hole{a + d, y}), averaged(overlap), 1e-12)
                    << "y " << y << " a " << a << " d " << d;
            }
        }
    }
}

TEST(LorentzAverage, PushAgreesWithQuadratureFromEqualHolesToDistantOnes) {
    for (const double y : half_widths) {
        for (const double a : {-0.9, 0.0, 0.488, 1.9}) {
            for (const double d : {0.0, 1e-13, 1e-8, 1e-4, 0.0101, 0.0202, 0.0301, -0.4, 1.0, -3.0}) {
                const auto push = [&](double v) {
                    return y * (a - v) / (y * y + (v - a) * (v - a)) * lorentzian(v, a + d, y);
                };
                EXPECT_NEAR(average_push(Hole{a, y}, Hole{a + d, y}), averaged(push), 1e-12)
                    << "y " << y << " a " << a << " d " << d;
            }
        }
    }
}

TEST(LorentzAverage, OverlapIsSymmetric) {
    for (const double d : {1e-9, 0.01, 0.02, 0.3}) {
        const Hole a{0.4, 0.1433};
        const Hole b{0.4 + d, 0.1433};
        EXPECT_NEAR(average_overlap(a, b), average_overlap(b, a), 1e-15) << d;
    }
}

// Far wider than the distribution, a Lorentzian is one everywhere in it.
TEST(LorentzAverage, OfAVeryWideLineIsOne) {
    const Hole wide{0.0, 1e4};
    EXPECT_NEAR(average_line(wide), 1.0, 1e-7);
    EXPECT_NEAR(average_overlap(wide, wide), 1.0, 1e-7);
}

}  // namespace zlg::twin::lorentz_average_test
