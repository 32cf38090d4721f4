#include <zlg/config/schema.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/wiring.hpp>

#include "test.hpp"

namespace zlg::closed_loop_test {

config::Config every_second() {
    config::Config c;
    c.switching.interval_s = 1.0;
    return c;
}

std::vector<rig::LoopHalf> advance(const config::Config& c, int halves) {
    rig::ClosedLoop loop{c, rig::motion(c)};
    std::vector<rig::LoopHalf> all;
    for (int h = 0; h < halves; ++h) all.push_back(loop.advance());
    return all;
}

// Ticks in which the loop is open, 200 ticks a second.
void expect_gaps_on_the_grid(const config::Config& c) {
    const auto halves = advance(c, 2000);
    int mode = 1;
    for (int h = 0; h < 2000; ++h) {
        const int tick = h / 2;
        const bool in_gap = tick >= 200 && tick % 200 < 3;
        if (in_gap && tick % 200 == 0 && h % 2 == 0) mode = -mode;
        const core::HalfRecord& r = halves[static_cast<std::size_t>(h)].record;
        ASSERT_EQ(r.half, h);
        ASSERT_EQ(r.loop_closed, !in_gap) << "half " << h;
        ASSERT_EQ(r.mode, mode) << "half " << h;
        ASSERT_EQ(r.bias_sign, h % 2 == 0 ? 1 : -1);
        if (!in_gap) ASSERT_TRUE(r.valid) << "half " << h;
    }
}

TEST(ClosedLoop, opens_for_three_ticks_on_the_grid_and_alternates_helicity) {
    for (const auto loop : {config::Loop::analog, config::Loop::exponential, config::Loop::digital}) {
        config::Config c = every_second();
        c.perimeter.loop = loop;
        expect_gaps_on_the_grid(c);
    }
}

TEST(ClosedLoop, closes_with_the_miss_that_was_asked_for_and_locks_again) {
    for (const auto loop : {config::Loop::analog, config::Loop::digital}) {
        config::Config c = every_second();
        c.perimeter.loop = loop;
        c.perimeter.miss_lambda = 0.1;
        const auto halves = advance(c, 800);
        EXPECT_NEAR(std::abs(halves[405].truth.detuning_end_lambda), 0.1, 2e-3);
        EXPECT_NEAR(std::abs(halves[460].truth.detuning_end_lambda), 0.0, 5e-3);
    }
}

TEST(ClosedLoop, learns_the_half_wave_voltage_from_its_switches) {
    config::Config c = every_second();
    c.perimeter.miss_lambda = 0.0;
    c.piezo.half_wave_error = 0.05;
    const auto halves = advance(c, 6000);
    EXPECT_DOUBLE_EQ(halves.front().half_wave_v, 42.0);
    EXPECT_NEAR(halves.back().half_wave_v, 40.0, 3.0 * halves.back().half_wave_sigma_v);
    EXPECT_LT(halves.back().half_wave_sigma_v, 0.3);
}

// The recorded detuning is the mean of what both beams' samples say.
// But for the balance of the photodiodes, which has been learnt after a second, and then hardly moves.
TEST(ClosedLoop, gives_the_samples_of_both_beams_that_the_control_saw) {
    const config::Config c = every_second();
    rig::ClosedLoop loop{c, rig::motion(c)};
    double balance_before = 0.0;
    for (int h = 0; h < 1000; ++h) {
        const core::HalfRecord record = loop.advance().record;
        const core::LightSamples light = loop.light();
        ASSERT_EQ(light.a.size(), 16u);
        ASSERT_EQ(light.b.size(), 16u);
        if (!record.valid || !record.loop_closed) continue;
        double seen = 0.0;
        for (std::size_t k = 0; k < 16; ++k) {
            const double a = static_cast<double>(light.a[k]);
            const double b = static_cast<double>(light.b[k]);
            seen += (a - b) / (a + b) / 16.0;
        }
        const double taken = record.bias_sign * record.mode * c.gyro.discriminator_per_lambda * record.detuning_lambda;
        const double balance = (seen - taken) / (1.0 - seen * taken);
        if (h > 400) ASSERT_NEAR(balance, balance_before, 3e-5) << "half " << h;
        balance_before = balance;
    }
}

TEST(ClosedLoop, counts_follow_rotation_and_bias) {
    config::Config c;
    c.motion.kind = config::MotionKind::constant;
    c.motion.rate_arcsec_s = 3.263 * 2000.0;  // 5 counts a half
    const auto halves = advance(c, 4);
    for (const auto& h : halves)
        EXPECT_NEAR(static_cast<double>(h.record.counts), h.record.bias_sign * h.record.mode * 150.0 + 5.0, 1.5);
}

TEST(ClosedLoop, refuses_a_gyro_that_cannot_be) {
    config::Config c;
    c.piezo.range_max_v = c.piezo.range_min_v;
    EXPECT_THROW((rig::ClosedLoop{c, rig::motion(c)}), config::ConfigError);
}

}  // namespace zlg::closed_loop_test
