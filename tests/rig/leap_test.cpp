#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/leap.hpp>
#include <zlg/rig/wiring.hpp>

#include "config_with.hpp"
#include "test.hpp"

namespace zlg::leap_test {

config::Config events(std::initializer_list<std::string_view> settings = {}) {
    config::Config c = test::config_with(settings);
    c.gyro.fidelity = config::Fidelity::events;
    return c;
}

struct Passed {
    std::vector<core::HalfRecord> lived;
    std::vector<std::pair<std::int64_t, rig::Leap>> leapt;  // by its first half
};

Passed pass(const config::Config& c, std::int64_t halves) {
    rig::ClosedLoop loop{c, rig::motion(c)};
    Passed passed;
    for (std::int64_t half = 0; half < halves;) {
        if (const auto leap = half % 2 == 0 ? loop.leap(halves - half) : std::nullopt) {
            passed.leapt.emplace_back(half, *leap);
            half += leap->halves;
            continue;
        }
        passed.lived.push_back(loop.advance().record);
        EXPECT_EQ(passed.lived.back().half, half++);
    }
    return passed;
}

// Every opening of the grid is lived in its tick, with what is before and behind it, and no half is lost by a leap.
TEST(Leap, the_loop_switches_on_its_grid_and_lives_what_is_around) {
    for (const char* loop : {"analog", "exponential", "digital"}) {
        const config::Config c = events({std::string{"perimeter.loop="} + loop, "switching.interval_s=30"});
        const Passed passed = pass(c, 2 * 20'000);
        ASSERT_GT(passed.leapt.size(), 30u) << loop;
        ASSERT_LT(passed.lived.size(), 3000u) << loop;
        int mode = 1;
        std::int64_t before = -1, lived_in_row = 0, n_switches = 0;
        for (const core::HalfRecord& r : passed.lived) {
            lived_in_row = r.half == before + 1 ? lived_in_row + 1 : 1;
            before = r.half;
            if (r.mode != mode) {
                ++n_switches;
                mode = r.mode;
                EXPECT_EQ(r.half, 12'000 * n_switches);
                EXPECT_GT(lived_in_row, 40) << loop;
            }
            EXPECT_TRUE(!r.loop_closed || r.valid) << loop << " half " << r.half;
        }
        EXPECT_EQ(n_switches, 3);
    }
}

TEST(Leap, no_other_fidelity_leaps_and_a_gyro_with_a_memory_says_why_not) {
    config::Config c;
    rig::ClosedLoop lived{c, rig::motion(c)};
    for (int half = 0; half < 4000; ++half) (void)lived.advance();
    EXPECT_FALSE(lived.leap(100'000));
    const config::Config creeping = events({"piezo.creep_per_decade=0.01"});
    EXPECT_EQ(rig::why_lived(creeping, rig::motion(creeping)), "piezo.creep_per_decade = 0.01");
    EXPECT_TRUE(pass(creeping, 8000).leapt.empty());
    const config::Config fast = events({"motion.kind=sine", "motion.amplitude_arcsec_s=6e4", "motion.frequency_hz=1"});
    EXPECT_NE(rig::why_lived(fast, rig::motion(fast)), "");
    EXPECT_EQ(rig::why_lived(events(), rig::motion(c)), "");
}

TEST(Leap, faults_are_lived) {
    const config::Config c = events({"faults.kind=[\"laser_off\"]", "faults.at_s=[20.0]", "faults.duration_s=[0.3]",
                                     "faults.size=[0.0]", "switching.interval_s=90"});
    const Passed passed = pass(c, 2 * 8000);
    ASSERT_FALSE(passed.leapt.empty());
    for (const auto& [first, leap] : passed.leapt)
        EXPECT_TRUE(first + leap.halves < 8000 - 40 || first > 8000 + 120) << first;
    EXPECT_TRUE(std::ranges::any_of(passed.lived, [](const core::HalfRecord& r) { return r.half > 8000 && !r.valid; }));
}

// The schedule stepped tick by tick finds the opening where it is foretold, or just behind.
TEST(Leap, the_next_opening_is_foretold) {
    for (const core::ScheduleKind kind : {core::ScheduleKind::fixed, core::ScheduleKind::measured}) {
        for (const core::FirstSegment first : {core::FirstSegment::full, core::FirstSegment::half}) {
            core::SwitchScheduleConfig c{.interval_ticks = 700, .first_segment = first, .kind = kind, .min_ticks = 300};
            c.max_ticks = 900;
            c.end_tick = 6000;
            core::SwitchScheduleState s = initial_state(c);
            std::int8_t mode = 1;
            // The first tick lays the centre of the sawtooth.
            (void)step(c, s, {.tick = 1, .mode = mode});
            std::int64_t foretold = rig::next_opening(c, s, 2, mode);
            for (std::int64_t tick = 2; tick < 6000; ++tick) {
                ASSERT_LE(std::abs(rig::next_opening(c, s, tick, mode) - foretold), 2) << tick;
                if (!step(c, s, {.tick = tick, .mode = mode})) continue;
                ASSERT_GE(tick, foretold);
                ASSERT_LE(tick - foretold, 2);
                mode = static_cast<std::int8_t>(-mode);
                foretold = rig::next_opening(c, s, tick + 1, mode);
            }
        }
    }
}

// A gyro without noise whose light, bias and temperature change: what the control is after leaps and the halves
// before an event, it is after the halves alone.
TEST(Leap, the_control_is_as_after_the_halves) {
    config::Config c = events({"gyro.light_noise_lambda=0", "drift.random_walk_arcsec_sqrt_s=0",
                               "light.gain_drift_per_h=0.05", "light.power_decay_per_h=0.1", "drift.thermal_time_s=300",
                               "gyro.bias_temperature_coefficient_per_c=1e-4", "switching.interval_s=1e6"});
    rig::ClosedLoop leaping{c, rig::motion(c)};
    std::int64_t half = 0;
    while (half < 24'000) {
        if (const auto leap = half % 2 == 0 ? leaping.leap(24'000 - half) : std::nullopt) {
            half += leap->halves;
        } else {
            (void)leaping.advance();
            ++half;
        }
    }
    for (int h = 0; h < 80; ++h, ++half) (void)leaping.advance();
    c.gyro.fidelity = config::Fidelity::averaged;
    rig::ClosedLoop living{c, rig::motion(c)};
    for (std::int64_t h = 0; h < half; ++h) (void)living.advance();
    const core::GyroControlState& a = living.control();
    const core::GyroControlState& b = leaping.control();
    EXPECT_EQ(b.half, a.half);
    EXPECT_EQ(b.order.expected, a.order.expected);
    EXPECT_EQ(b.commutator.expected_ticks, a.commutator.expected_ticks);
    EXPECT_EQ(b.schedule.imbalance_ticks, a.schedule.imbalance_ticks);
    EXPECT_LE(std::abs(static_cast<std::int64_t>(b.counter - a.counter)), 1);
    EXPECT_NEAR(b.mean_temperature_c, a.mean_temperature_c, 2e-3);
    EXPECT_NEAR(b.temperature_c, a.temperature_c, 1e-9);
    // A hundredth of what is left where the drift of the balance is not led on as by the halves.
    EXPECT_NEAR(b.light_balance.weight / a.light_balance.weight, 1.0, 1e-6);
    EXPECT_NEAR(b.light_balance.drift / a.light_balance.drift, 1.0, 0.02);
    EXPECT_NEAR(b.light_balance.level / a.light_balance.level, 1.0, 1e-4);
    EXPECT_NEAR(b.bias_monitor.bias_counts, a.bias_monitor.bias_counts, 0.3);
    EXPECT_NEAR(b.piezo_v, a.piezo_v, 0.15);
}

// By phase the angle of a leap is that between two readings that err alike.
TEST(Leap, by_phase_a_leap_ends_at_a_place_within_the_count) {
    twin::Leap passed;
    passed.halves = 2;
    passed.turned_counts = 10.75;
    passed.counts = 11;
    core::HalfRecord last;
    last.fringe = 0.5F * core::count_parts;
    const rig::Leap made = rig::leap_of(std::move(passed), last);
    EXPECT_EQ(made.counts, 11);
    EXPECT_EQ(made.end_parts, core::count_parts / 4);
    EXPECT_EQ(made.parts, -core::count_parts / 4);
}

}  // namespace zlg::leap_test
