#include <laser/competition.hpp>

#include "test.hpp"

namespace zlg::twin::competition_test {

// Two waves; the others have no gain and touch nobody.
Competition two_waves(double gain_1, double gain_2, double cross) {
    Competition c;
    c.net_gain = {gain_1, gain_2, -1.0, -1.0};
    for (unsigned i = 0; i < n_waves; ++i) c.saturation[i][i] = 1.0;
    c.saturation[0][1] = c.saturation[1][0] = cross;
    return c;
}

TEST(Competition, TwoWavesShareAsTheTextbookSays) {
    const Balance b = steady_state(two_waves(1.0, 0.8, 0.5));
    EXPECT_EQ(b.lit, 3U);
    EXPECT_NEAR(b.value[0], (1.0 - 0.5 * 0.8) / 0.75, 1e-15);
    EXPECT_NEAR(b.value[1], (0.8 - 0.5 * 1.0) / 0.75, 1e-15);
}

TEST(Competition, TheWeakerWaveGoesOutWhereItsGainFallsBelowTheCrossSaturation) {
    EXPECT_EQ(steady_state(two_waves(1.0, 0.501, 0.5)).lit, 3U);
    const Balance b = steady_state(two_waves(1.0, 0.499, 0.5));
    EXPECT_EQ(b.lit, 1U);
    EXPECT_NEAR(b.value[0], 1.0, 1e-15);
    EXPECT_NEAR(b.value[1], -0.001, 1e-15);
}

TEST(Competition, WithoutGainAllIsDark) {
    const Balance b = steady_state(two_waves(-1e-9, -0.2, 0.5));
    EXPECT_EQ(b.lit, 0U);
    EXPECT_DOUBLE_EQ(b.value[0], -1e-9);
}

// A set whose waves saturate each other as themselves has no balance; the stronger wave wins.
TEST(Competition, OfWavesThatBurnTheSameHoleTheStrongerWins) {
    Balance unused;
    EXPECT_FALSE(balance_of(two_waves(1.0, 0.9, 1.0), 3U, unused));
    const Balance b = steady_state(two_waves(0.9, 1.0, 1.0));
    EXPECT_EQ(b.lit, 2U);
    EXPECT_NEAR(b.value[1], 1.0, 1e-15);
}

// A Gram matrix of random vectors, as the saturations of a gas are.
Competition random_competition(std::mt19937_64& random) {
    std::normal_distribution<double> gauss;
    double hole[n_waves][6];
    for (auto& h : hole) {
        for (double& x : h) x = std::abs(gauss(random));
    }
    for (unsigned i = 0; i < n_waves; ++i) hole[i][i] += 3.0;
    Competition c;
    for (unsigned i = 0; i < n_waves; ++i) {
        c.net_gain[i] = gauss(random) + 0.5;
        for (unsigned j = 0; j < n_waves; ++j) {
            for (unsigned k = 0; k < 6; ++k) c.saturation[i][j] += hole[i][k] * hole[j][k];
        }
    }
    return c;
}

// Kuhn and Tucker: no intensity is negative, no dark wave has gain left, every lit wave has none.
TEST(Competition, InRandomGasNoWaveCouldGainByBeingLitOrDark) {
    std::mt19937_64 random{7};
    int seen[5] = {};
    for (int trial = 0; trial < 20000; ++trial) {
        const Competition c = random_competition(random);
        const Balance b = steady_state(c);
        for (unsigned i = 0; i < n_waves; ++i) {
            double spare = c.net_gain[i];
            for (unsigned j = 0; j < n_waves; ++j) {
                if (b.lit >> j & 1U) spare -= c.saturation[i][j] * b.value[j];
            }
            const bool lit = b.lit >> i & 1U;
            ASSERT_TRUE(lit ? b.value[i] >= -1e-12 && std::abs(spare) < 1e-10 : spare <= 1e-10) << trial;
        }
        ++seen[std::popcount(b.lit)];
    }
    for (const int n : seen) EXPECT_GT(n, 50);
}

// The state is where the waves go from a random start: their growth is followed in time.
TEST(Competition, TheSteadyStateIsWhereTheWavesGo) {
    std::mt19937_64 random{11};
    std::uniform_real_distribution<double> start{0.01, 2.0};
    for (int trial = 0; trial < 50; ++trial) {
        const Competition c = random_competition(random);
        std::array<double, n_waves> intensity{start(random), start(random), start(random), start(random)};
        for (int step = 0; step < 200000; ++step) {
            std::array<double, n_waves> rate = c.net_gain;
            for (unsigned i = 0; i < n_waves; ++i) {
                for (unsigned j = 0; j < n_waves; ++j) rate[i] -= c.saturation[i][j] * intensity[j];
            }
            for (unsigned i = 0; i < n_waves; ++i) intensity[i] *= std::exp(0.01 * rate[i]);
        }
        const Balance b = steady_state(c);
        for (unsigned i = 0; i < n_waves; ++i) {
            EXPECT_NEAR(intensity[i], b.lit >> i & 1U ? b.value[i] : 0.0, 1e-3) << "trial " << trial << " wave " << i;
        }
    }
}

}  // namespace zlg::twin::competition_test
