// A gap with lit halves; their estimate is held against NumPy in tests/core/test_estimate.py.

#include <zlg/core/gyro_compensation.hpp>

#include "gyro_compensation_support.hpp"

namespace zlg::core::gyro_compensation_lit_test {

using namespace gyro_compensation_support;

constexpr int gap_tick = 400;
constexpr int gap_ticks = 3;
constexpr double miss_sq = 0.0484;

GyroCompensationConfig config_of(RelockMethod relock) {
    GyroCompensationConfig c;
    c.gyro.random_walk = ArcsecPerRootSecond{0.0};
    c.relock = {.method = relock};
    c.bridge.method = BridgeMethod::automatic;
    return c;
}

double motion(int half) {
    const double t = 0.0025 * half;
    return 28.0 * std::cos(2.0 * std::numbers::pi * 20.0 * t) + 11.0 * std::cos(377.0 * t + 1.0);
}

Halves records(const GyroCompensationConfig& config, bool lit, double size = 1.0, double sq = miss_sq) {
    Halves all;
    Recorder recorder{config, 1, 1};
    for (int h = 0; h < 2 * gap_tick + 120; ++h) {
        const bool open = h >= 2 * gap_tick && h < 2 * (gap_tick + gap_ticks);
        HalfRecord r = recorder.half(size * motion(h), open ? sq : 0.0);
        r.detuning_sq_lambda2 += 0.0033 * 0.0033;
        r.loop_closed = !open;
        r.lit = lit && h >= 2 * gap_tick + 3;
        if (open && h < 2 * gap_tick + 3) r.counts += 60 - 17 * (h % 3);  // dark
        all.push_back(r);
    }
    return all;
}

TEST(GyroCompensationLit, TheyNarrowTheGap) {
    for (const RelockMethod relock : {RelockMethod::mean_square, RelockMethod::joint}) {
        const GyroCompensationConfig config = config_of(relock);
        const Delivered with = run(config, records(config, true));
        const Delivered without = run(config, records(config, false));
        ASSERT_EQ(with.gaps.size(), 1u);
        EXPECT_LT(with.gaps[0].sigma_sum_arcsec, without.gaps[0].sigma_sum_arcsec);
        // In the last tick of the gap both halves were read.
        double truth = 0.0;
        for (int h = 2 * gap_tick + 4; h < 2 * gap_tick + 6; ++h) truth += motion(h);
        EXPECT_NEAR(with.rows[gap_tick + 2].dtheta_final_arcsec, truth,
                    4.0 * config.gyro.scale.value() / std::sqrt(6.0));
    }
}

// Of a data sheet, chi is known to a tenth at first: so are the false angles that lit halves are judged by.
TEST(GyroCompensationLit, AChiThatIsATenthOffRefusesNone) {
    const GyroCompensationConfig right = config_of(RelockMethod::joint);
    GyroCompensationConfig wrong = right;
    wrong.gyro.chi *= 1.1;
    const Halves halves = records(right, true, 0.0, 0.16);
    const GapReport usual = run(right, halves).gaps.at(0);
    EXPECT_LT(run(wrong, halves).gaps.at(0).sigma_sum_arcsec, 1.5 * usual.sigma_sum_arcsec);
}

// Ticks behind the window of the estimate are corrected one by one, each with the noise of its two mean squares:
// the sum of their variances is in the sigma of the switch.
TEST(GyroCompensationLit, SigmaHoldsTheCorrectionsBehindTheWindow) {
    GyroCompensationConfig config = config_of(RelockMethod::mean_square);
    config.gyro.light_noise = Wavelengths{0.02};
    config.relock.ticks = 20;
    const Halves halves = records(config, false);
    const double within = run(config, halves).gaps.at(0).sigma_sum_arcsec;
    config.relock.ticks = 40;
    const double all = run(config, halves).gaps.at(0).sigma_sum_arcsec;
    const double noise_sq = std::pow(config.gyro.light_noise.value(), 2);
    const double unit =
        config.gyro.chi * config.gyro.bias.value() * config.gyro.scale.value() * config.gyro.tick.value() / 2;
    // <dl^2> of the records beyond the noise is 0 there.
    const double of_a_tick = std::pow(unit * noise_sq, 2) * 4.0 / config.gyro.light_samples;
    EXPECT_NEAR(all * all - within * within, 20.0 * of_a_tick, 0.2 * 20.0 * of_a_tick);
}

// Delivered and final values have the same sum, with lit halves too.
TEST(GyroCompensationLit, TheSumsOfBothColumnsAreEqual) {
    const GyroCompensationConfig config = config_of(RelockMethod::mean_square);
    const Sums sums = sums_of(run(config, records(config, true)), false);
    EXPECT_NEAR(sums.delivered, sums.final, 1e-9);
}

// Lit halves that turn by nonsense are refused: the angle is that without them, to the last bit. It may be a rotation,
// and sigma holds it.
TEST(GyroCompensationLit, NonsenseThatIsCalledLitIsRefused) {
    const GyroCompensationConfig config = config_of(RelockMethod::mean_square);
    Halves bad = records(config, true);
    Halves none = records(config, false);
    for (std::size_t h = 2 * gap_tick; h < 2 * (gap_tick + gap_ticks); ++h) {
        bad[h].counts = none[h].counts = static_cast<std::int64_t>(h * 7919 % 400) - 200;
        bad[h].lit = true;
    }
    const Delivered a = run(config, bad);
    const Delivered b = run(config, none);
    ASSERT_EQ(a.rows.size(), b.rows.size());
    for (std::size_t k = 0; k < a.rows.size(); ++k) {
        EXPECT_EQ(a.rows[k].dtheta_final_arcsec, b.rows[k].dtheta_final_arcsec);
        const bool in_gap = k >= gap_tick && k < gap_tick + gap_ticks;
        if (in_gap)
            EXPECT_GT(a.rows[k].sigma_arcsec, 100.0);
        else
            EXPECT_EQ(a.rows[k].sigma_arcsec, b.rows[k].sigma_arcsec);
    }
}

}  // namespace zlg::core::gyro_compensation_lit_test
