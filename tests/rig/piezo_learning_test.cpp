// The control against a piezo that creeps and remembers, and the fast re-lock, in the loop with the twin.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <zlg/config/schema.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/laser_calibration.hpp>
#include <zlg/rig/wiring.hpp>

namespace {

using namespace zlg;

config::Config gyro_of(config::Fidelity fidelity) {
    config::Config c;
    c.gyro.fidelity = fidelity;
    return fidelity == config::Fidelity::laser ? rig::calibrated_by_laser(c) : c;
}

config::Config real_piezo(double stroke_v, config::Fidelity fidelity = config::Fidelity::averaged) {
    config::Config c = gyro_of(fidelity);
    c.motion.kind = config::MotionKind::rest;
    c.perimeter.miss_lambda = 0.0;
    c.piezo.hysteresis = 0.12;
    c.piezo.hysteresis_stroke_v = stroke_v;
    c.piezo.creep_per_decade = 0.015;
    c.piezo.mirror_hz = 5000.0;
    return c;
}

// True detuning at the end of each gap.
std::vector<double> misses(const config::Config& c, int n) {
    rig::ClosedLoop loop{c, rig::motion(c)};
    std::vector<double> found;
    double before = 0.0;
    bool open = false;
    while (static_cast<int>(found.size()) < n) {
        const rig::LoopHalf half = loop.advance();
        if (open && half.record.loop_closed) found.push_back(std::abs(before));
        open = !half.record.loop_closed;
        before = half.truth.detuning_end_lambda;
    }
    return found;
}

TEST(PiezoLearning, TheMissFallsFromATenthToAHundredthInTenSwitches) {
    for (const double stroke_v : {300.0, 40.0}) {
        for (const auto loop : {config::Loop::analog, config::Loop::digital}) {
            for (const auto fidelity : {config::Fidelity::averaged, config::Fidelity::laser}) {
                if (fidelity == config::Fidelity::laser && loop == config::Loop::analog) continue;
                config::Config c = real_piezo(stroke_v, fidelity);
                c.perimeter.loop = loop;
                c.perimeter.relock_halves = 4;
                c.piezo.half_wave_error = 0.05;
                const std::vector<double> miss = misses(c, 14);
                EXPECT_LE(miss[0], 0.10) << stroke_v;
                EXPECT_GE(miss[0], 0.03) << "the piezo must make learning hard";
                for (std::size_t k = 10; k < 14; ++k) EXPECT_LE(miss[k], 0.010) << stroke_v << " V, switch " << k + 1;
            }
        }
    }
}

// Mean |dl| of the halves after closing, and the largest of the fourth, from light without noise.
struct Relock {
    double first = 0.0;
    double second = 0.0;
    double fourth_worst = 0.0;
};

Relock relock(double light_gain, config::Fidelity fidelity) {
    config::Config c = gyro_of(fidelity);
    c.motion.kind = config::MotionKind::rest;
    c.switching.interval_s = 1.0;
    c.perimeter.loop = config::Loop::digital;
    c.perimeter.relock_halves = 4;
    c.perimeter.miss_lambda = 0.05;
    c.gyro.light_noise_lambda = 0.0;
    core::GyroControlConfig control = rig::control_config(c);
    control.detector.discriminator_per_lambda /= light_gain;
    twin::Twin twin{rig::twin_config(c), rig::motion(c)};
    core::GyroControlState state = initial_state(control);
    core::ActuatorFrame actuator = initial_actuator(control);
    Relock seen;
    int since = 100;
    int n = 0;
    for (int h = 0; h < 400 * 20; ++h) {
        const bool was_open = !actuator.loop_closed;
        const core::GyroControlOutput out = step(control, state, twin.advance(actuator).sensor);
        const double size = std::abs(out.record.detuning_lambda) / light_gain;
        if (since == 0) seen.first += size;
        if (since == 1) seen.second += size;
        if (since == 3) seen.fourth_worst = std::max(seen.fourth_worst, size);
        ++since;
        actuator = out.actuator;
        if (was_open && actuator.loop_closed) {
            since = 0;
            ++n;
        }
    }
    seen.first /= n;
    seen.second /= n;
    return seen;
}

TEST(PiezoLearning, TheDigitalLoopLocksWithinTwoTicksWithThirtyPercentOfGainError) {
    for (const double gain : {0.7, 1.0, 1.3}) {
        for (const auto fidelity : {config::Fidelity::averaged, config::Fidelity::laser}) {
            const Relock seen = relock(gain, fidelity);
            EXPECT_LE(seen.first, 0.042) << gain;
            EXPECT_LE(seen.second, 0.013) << gain;
            EXPECT_LE(seen.fourth_worst, 0.003) << gain;
        }
    }
}

TEST(PiezoLearning, AnIdealPiezoIsLearntAsBefore) {
    const core::GyroControlConfig ideal = rig::control_config(config::Config{});
    EXPECT_FALSE(ideal.by_direction);
    EXPECT_EQ(ideal.mode_switch.settle_ticks, core::ModeSwitchConfig{}.settle_ticks);
    EXPECT_TRUE(rig::control_config(real_piezo(300.0)).by_direction);
}

}  // namespace
