#include <zlg/study/half_wave_replay.hpp>

#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <zlg/config/schema.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/wiring.hpp>

namespace {

using namespace zlg;

config::Config gyro(std::initializer_list<std::string_view> settings = {}) {
    config::Config c;
    c.switching.interval_s = 2.0;
    for (const auto setting : settings) config::apply_set(c, setting);
    return c;
}

struct Live {
    std::vector<core::HalfRecord> records;
    std::vector<study::SwitchLine> lines;  // of the control
};

Live live(const config::Config& c, int halves = 8000) {
    rig::ClosedLoop loop{c, rig::motion(c)};
    Live made;
    for (int h = 0; h < halves; ++h) {
        const rig::LoopHalf half = loop.advance();
        made.records.push_back(half.record);
        if (!half.control.has_event) continue;
        made.lines.push_back({.tick = half.control.event.tick_opened,
                              .half_wave_v = half.half_wave_v,
                              .half_wave_sigma_v = half.half_wave_sigma_v});
    }
    return made;
}

// The switches of those lines, filled from the records.
std::vector<study::SwitchLine> filled(const config::Config& c, const Live& from) {
    study::HalfWaveReplay replay{c};
    for (const core::HalfRecord& half : from.records) replay.take(half);
    std::vector<study::SwitchLine> lines;
    for (const study::SwitchLine& line : from.lines) lines.push_back({.tick = line.tick});
    replay.fill(lines);
    return lines;
}

TEST(HalfWaveReplay, gives_what_the_control_has_learnt_to_the_bit) {
    for (const config::Config& c :
         {gyro(), gyro({"piezo.half_wave_error=0.05", "piezo.hysteresis=0.1"}),
          gyro({"switching.gap_ticks=8", "switching.gap_min_ticks=1", "perimeter.loop=\"digital\""})}) {
        const Live run = live(c);
        const auto lines = filled(c, run);
        ASSERT_GT(lines.size(), 5u);
        for (std::size_t k = 0; k < lines.size(); ++k) {
            EXPECT_EQ(lines[k].half_wave_v, run.lines[k].half_wave_v) << k;
            EXPECT_EQ(lines[k].half_wave_sigma_v, run.lines[k].half_wave_sigma_v) << k;
        }
    }
}

// A gap of one tick closes so far from the centre that the counts of the first half are not valid.
TEST(HalfWaveReplay, takes_a_detuning_of_a_half_whose_counts_are_not_valid) {
    const config::Config c = gyro({"switching.gap_ticks=1", "switching.interval_s=1.0"});
    const Live run = live(c);
    const auto lines = filled(c, run);
    ASSERT_GT(lines.size(), 10u);
    for (std::size_t k = 0; k < lines.size(); ++k) EXPECT_EQ(lines[k].half_wave_v, run.lines[k].half_wave_v) << k;
}

TEST(HalfWaveReplay, gives_the_same_for_any_gyro) {
    std::mt19937_64 random{11};
    const auto between = [&](double low, double high) { return std::uniform_real_distribution<>{low, high}(random); };
    for (int trial = 0; trial < 12; ++trial) {
        config::Config c = gyro();
        c.run.seed = static_cast<std::uint64_t>(trial + 1);
        c.switching.interval_s = between(0.3, 2.0);
        c.switching.gap_ticks = static_cast<int>(between(1.0, 12.0));
        c.switching.gap_min_ticks = trial % 3 == 0 ? 1 : 0;
        config::apply_set(c, trial % 2 == 0 ? "perimeter.loop=\"analog\"" : "perimeter.loop=\"digital\"");
        c.perimeter.miss_lambda = between(0.0, 0.1);
        c.piezo.half_wave_error = between(-0.08, 0.08);
        c.piezo.hysteresis = between(0.0, 0.15);
        c.piezo.adc_noise_v = between(0.0, 0.1);
        const Live run = live(c, 4000);
        const auto lines = filled(c, run);
        for (std::size_t k = 0; k < lines.size(); ++k) {
            if (std::isnan(lines[k].half_wave_v)) continue;  // before the first lock that measured
            EXPECT_EQ(lines[k].half_wave_v, run.lines[k].half_wave_v) << trial << ' ' << k;
            EXPECT_EQ(lines[k].half_wave_sigma_v, run.lines[k].half_wave_sigma_v) << trial << ' ' << k;
        }
    }
}

TEST(HalfWaveReplay, knows_nothing_without_voltage_or_detuning) {
    const double nan = std::nan("");
    for (const std::function<void(core::HalfRecord&)>& lose :
         {std::function<void(core::HalfRecord&)>{[nan](auto& h) { h.piezo_v = nan; }},
          std::function<void(core::HalfRecord&)>{[nan](auto& h) { h.detuning_lambda = nan; }}}) {
        Live run = live(gyro());
        for (core::HalfRecord& half : run.records) lose(half);
        for (const study::SwitchLine& line : filled(gyro(), run)) EXPECT_TRUE(std::isnan(line.half_wave_v));
    }
}

// The loop opens once more before the lock of the second switch: its measurement is lost, those of the others are not.
TEST(HalfWaveReplay, goes_on_behind_a_switch_that_was_not_seen_to_lock) {
    Live run = live(gyro());
    ASSERT_GT(run.lines.size(), 4u);
    const auto second = static_cast<std::size_t>(2 * run.lines[1].tick);
    for (std::size_t h = second + 10; h < second + 14; ++h) run.records[h].loop_closed = false;
    const auto lines = filled(gyro(), run);
    EXPECT_TRUE(std::isnan(lines[1].half_wave_v));
    EXPECT_EQ(lines[0].half_wave_v, run.lines[0].half_wave_v);
    for (const std::size_t k : {2u, 3u}) EXPECT_NEAR(lines[k].half_wave_v, run.lines[k].half_wave_v, 0.5);
}

TEST(HalfWaveReplay, a_configuration_that_the_control_refuses_gives_nothing) {
    config::Config c = gyro();
    const Live run = live(c, 3000);
    c.piezo.half_wave_error = std::nan("");
    ASSERT_FALSE(run.lines.empty());
    for (const study::SwitchLine& line : filled(c, run)) EXPECT_TRUE(std::isnan(line.half_wave_v));
}

}  // namespace
