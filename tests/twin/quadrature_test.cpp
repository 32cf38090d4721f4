#include <zlg/twin/quadrature.hpp>

#include "test.hpp"
#include "turns_from.hpp"

namespace zlg::twin::quadrature_test {

Signals phasor(double turns_now, double amplitude = 1.0) {
    const double angle = 2.0 * std::numbers::pi * turns_now;
    return {amplitude * std::sin(angle), amplitude * std::cos(angle)};
}

TEST(QuadratureDecoder, CountsFourATurnBothWays) {
    QuadratureDecoder decoder{0.0, 0};
    for (int i = 0; i <= 1600; ++i) decoder.see(phasor(0.001 + i / 16.0));
    EXPECT_EQ(decoder.quarters(), 400);
    for (int i = 1600; i >= -1600; --i) decoder.see(phasor(0.001 + i / 16.0));
    EXPECT_EQ(decoder.quarters(), -400);
    EXPECT_EQ(decoder.n_ambiguous(), 0);
}

TEST(QuadratureDecoder, SaysWhenItCannotTellTheDirection) {
    QuadratureDecoder decoder{0.0, 0};
    decoder.see(phasor(0.1));
    decoder.see(phasor(0.6));
    EXPECT_EQ(decoder.n_ambiguous(), 1);
    EXPECT_EQ(decoder.quarters(), 0);
    EXPECT_EQ(decoder.quadrant(), 2);
}

TEST(QuadratureDecoder, SignalsBelowTheThresholdMoveNothing) {
    QuadratureDecoder decoder{0.3, 0};
    for (int i = 0; i <= 1600; ++i) decoder.see(phasor(i / 16.0, 0.29));
    EXPECT_EQ(decoder.quarters(), 0);
}

TEST(QuarterTurns, AreTheFloorWithoutThreshold) {
    QuarterTurns quarters{turns(0.3)};
    EXPECT_EQ(quarters.value(), 1);
    for (const double t : {0.3, 17.99, 18.0, -0.01, -12.3, 4e9 + 0.76}) {
        quarters.see(turns(t), 0.0);
        EXPECT_EQ(quarters.value(), static_cast<std::int64_t>(std::floor(4.0 * t))) << t;
    }
}

TEST(QuarterTurns, CountOnAcrossTheWrap) {
    Turns t{std::int64_t{1} << 61, 0.1};
    QuarterTurns quarters{t};
    const std::int64_t before = quarters.value();
    t.add(-1.0);
    quarters.see(t, 0.01);
    EXPECT_EQ(static_cast<std::uint64_t>(before) - static_cast<std::uint64_t>(quarters.value()), 4u);
}

// The shortcut from turning point to turning point, against the electronics sample by sample.
TEST(QuarterTurns, AgreeWithTheDecoderOnRandomMotion) {
    std::mt19937_64 engine{5};
    std::normal_distribution<double> jump{0.0, 1.0};
    for (const double threshold : {0.0, 0.1, 0.5}) {
        const double lag = std::asin(threshold) / (2.0 * std::numbers::pi);
        double t = 0.13;
        QuadratureDecoder decoder{threshold, 0};
        QuarterTurns quarters{turns(t)};
        for (int i = 0; i < 2000; ++i) {
            const double to = t + jump(engine) * (i % 3 == 0 ? 5.0 : 0.2);
            const int n = 8 + static_cast<int>(64.0 * std::abs(to - t));
            for (int k = 1; k <= n; ++k) decoder.see(phasor(t + (to - t) * k / n));
            quarters.see(turns(to), lag);
            t = to;
            ASSERT_EQ(quarters.value(), decoder.quarters()) << i << " at " << t;
        }
        EXPECT_EQ(decoder.n_ambiguous(), 0);
    }
}

}  // namespace zlg::twin::quadrature_test
