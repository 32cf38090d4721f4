// Steps of the beats against a general integrator that reads the four-wave equations at every moment.

#include "laser/laser_beats.hpp"
#include "test.hpp"

#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>

#include <zlg/twin/four_wave.hpp>

namespace zlg::twin::laser_beats_test {

constexpr double tau = 2.0 * std::numbers::pi;
constexpr double half_edge_s = 25e-6;

struct Case {
    double perimeter_lambda;
    double common_hz;
    double lock_hz;
    double field_g = 15.0;
};

LaserConfig config_of(const Case& c) {
    LaserConfig config;
    config.lock_in_left_hz = c.lock_hz;
    return config;
}

// psi' = 2 pi [common + bias(B(t)) - lock (I1 + I2)/(2 sqrt(I1 I2)) sin psi] from zero field to the plateau.
double reference_turns(const Case& c, double start_turns) {
    using State = std::array<double, 1>;
    const FourWave laser{LaserConfig{}};
    const auto rhs = [&](const State& psi, State& dpsi, double t) {
        const WavePair pair = laser.at(c.perimeter_lambda, c.field_g * t / half_edge_s).left;
        const double lock_hz = 0.5 * c.lock_hz * (pair.cw + pair.ccw) / std::sqrt(pair.cw * pair.ccw);
        dpsi[0] = tau * (c.common_hz + pair.bias_hz - lock_hz * std::sin(psi[0]));
    };
    boost::numeric::odeint::runge_kutta_fehlberg78<State> stepper;
    State psi{tau * start_turns};
    constexpr int n = 100;
    for (int i = 0; i < n; ++i) stepper.do_step(rhs, psi, i * half_edge_s / n, half_edge_s / n);
    return psi[0] / tau - start_turns;
}

double stepped_turns(const Case& c, LaserBeats& beats, int n_pieces) {
    const Turns before = beats.beats().left();
    for (int k = 0; k < n_pieces; ++k) {
        Stretch s{.duration_s = half_edge_s / n_pieces, .common_hz = c.common_hz};
        s.perimeter_lambda.fill(c.perimeter_lambda);
        for (std::size_t i = 0; i < 3; ++i) s.field_g[i] = c.field_g * (k + 0.5 * static_cast<double>(i)) / n_pieces;
        (void)beats.edge(s);
    }
    return beats.beats().left().minus(before);
}

double error_rad(const Case& c, int n_pieces) {
    const LaserTable table{LaserConfig{}, c.field_g};
    LaserBeats beats{config_of(c), 1, table};
    double worst = 0.0;
    for (int run = 0; run < 12; ++run) {
        const double start = beats.beats().left().part;
        const double turned = stepped_turns(c, beats, n_pieces);
        worst = std::max(worst, std::abs(turned - reference_turns(c, start)) * tau);
    }
    return worst;
}

// One chord does as long as the waves are nearly equal and the field is not strong.
TEST(LaserBeats, AnEdgeIsRightToTenMicroradiansInOnePieceOrFour) {
    for (const int n_pieces : {1, 4}) {
        EXPECT_LT(error_rad({0.0, 0.0, 150.0}, n_pieces), 1e-5);
        EXPECT_LT(error_rad({0.0, 500.0, 300.0}, n_pieces), 1e-5);
        EXPECT_LT(error_rad({0.003, -40000.0, 150.0}, n_pieces), 1e-5);
        EXPECT_LT(error_rad({0.079, 0.0, 300.0}, n_pieces), 1e-5);
        EXPECT_LT(error_rad({0.05, 12345.0, 300.0, 20.0}, n_pieces), 1e-5);
    }
    EXPECT_GT(error_rad({0.0, 0.0, 300.0, 50.0}, 1), 1e-5);
    EXPECT_LT(error_rad({0.0, 0.0, 300.0, 50.0}, 4), 1e-5);
}

// Far from the centre the waves are unequal and change along the edge, which the pieces see in four steps.
TEST(LaserBeats, AnEdgeOfADetunedGyroIsRightToATenthOfAMilliradian) {
    EXPECT_LT(error_rad({0.1, 0.0, 300.0}, 4), 1e-5);
    EXPECT_LT(error_rad({0.2, 0.0, 300.0}, 4), 1e-4);
}

TEST(LaserBeats, APlateauTurnsByTheMeanOfItsBias) {
    constexpr double field_g = 15.0;
    const LaserTable table{LaserConfig{}, field_g};
    LaserBeats beats{config_of({0.0, 0.0, 0.0}), 1, table};
    Stretch s{.perimeter_lambda = {0.02, 0.06, 0.10}, .duration_s = 1e-3, .common_hz = 100.0, .helicity_hz = 7.0};
    s.field_g.fill(field_g);
    const Turns before = beats.beats().left();
    const Followed followed = beats.plateau(s);
    // The mean of dl^2 from 0.02 to 0.10 is 0.0124/3.
    const double bias_hz = 60430.0 * (1.0 - 3.59 * 0.0124 / 3.0);
    EXPECT_EQ(followed.helicity, 1);
    EXPECT_NEAR(followed.bias_hz, bias_hz, 10.0);
    EXPECT_NEAR(beats.beats().left().minus(before), 1e-3 * (bias_hz + 107.0), 0.01);
}

TEST(LaserBeats, TheLargerBeatIsFollowedAndNoneOfTwoEqualOnes) {
    constexpr double field_g = 15.0;
    const LaserTable table{LaserConfig{}, field_g};
    LaserBeats beats{LaserConfig{}, 1, table};
    const auto followed_at = [&](double perimeter) {
        Stretch s{.duration_s = 1e-5};
        s.perimeter_lambda.fill(perimeter);
        s.field_g.fill(field_g);
        return beats.plateau(s).helicity;
    };
    EXPECT_EQ(followed_at(0.0), 1);
    EXPECT_EQ(followed_at(0.22), 1);
    EXPECT_EQ(followed_at(0.25), 0);
    EXPECT_EQ(followed_at(0.28), -1);
    EXPECT_EQ(followed_at(0.5), -1);
}

}  // namespace zlg::twin::laser_beats_test
