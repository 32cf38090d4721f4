#include "scripts.hpp"

#include <array>
#include <cstdint>

#include <fmt/format.h>

namespace zlg::bench {
namespace {

using core::BridgeMethod;
using core::RelockMethod;

constexpr std::array<const char*, 4> relock_names{"none", "frequency", "detuning", "mean_square"};

std::string repeated(char tick, int n) { return std::string(static_cast<std::size_t>(n), tick); }

// A gyro that holds its mode, however dark: the next switch is far away.
Script script(std::string name, std::string ticks, int halves, int light_samples) {
    Script s;
    s.name = std::move(name);
    s.ticks = std::move(ticks);
    s.halves = halves;
    s.light_samples = static_cast<std::uint8_t>(light_samples);
    s.control.loop.kind = core::LoopKind::digital;
    s.control.schedule.interval_ticks = 1'000'000;
    s.control.mode_switch.dark_ticks = 1'000;
    s.control.mode_switch.lock_timeout_ticks = 1'000;
    s.control.limits.bias_counts = 150.0;
    s.control.limits.coil_ratio = 0.5 / 150.0;
    s.control.limits.light_noise = core::Wavelengths{0.0033};
    s.control.limits.bias_chi = 3.6;
    s.control.limits.detuning_change_lambda2 = 1.0 / 540.0;
    s.compensation.relock.method = RelockMethod::mean_square;
    return s;
}

// The same with switches, and the core's own gaps.
Script switching(std::string name, int gap_ticks, int settle_ticks, int light_samples, RelockMethod relock) {
    Script s = script(std::move(name), ".", 300, light_samples);
    s.control.schedule.interval_ticks = 60;
    s.control.mode_switch = {.gap_ticks = gap_ticks};
    s.control.mode_switch.settle_ticks = settle_ticks;
    s.compensation.relock.method = relock;
    return s;
}

// Edges that move with every reversal, by the law that costs more, and a rate that is judged often.
Script dithered(Script s) {
    core::EdgeDitherConfig& dither = s.control.commutator.dither;
    dither.method = core::DitherMethod::automatic;
    dither.rate_periods = 4;
    dither.random_above_arcsec_s = dither.paired_below_arcsec_s = 0.0;
    return s;
}

// All the points there may be.
Script with_most_points(Script s, int points_after = 8) {
    s = dithered(s);
    s.compensation.bridge.extrapolation_points = 8;
    s.compensation.bridge.points_before = 8;
    s.compensation.bridge.points_after = points_after;
    s.compensation.relock.method = RelockMethod::frequency;
    return s;
}

// Dark ticks come and go at random, in gaps of up to 20 ticks; the points are random too.
Script random(std::uint32_t seed) {
    std::uint32_t x = 747796405u * seed + 1u;
    const auto below = [&x](std::uint32_t n) {
        x = 1664525u * x + 1013904223u;
        return static_cast<int>((x >> 8) % n);
    };
    Script s = dithered(script(fmt::format("random {}", seed), "", 1000, 64));
    while (s.ticks.size() < 500) {
        s.ticks += repeated(lit, 1 + below(below(2) == 0 ? 30 : 4));
        s.ticks += repeated(dark, below(2) == 0 ? 16 : 1 + below(20));
        if (below(2) == 0) s.ticks.back() = half_dark;
    }
    core::GapBridgeConfig& bridge = s.compensation.bridge;
    bridge.extrapolation_points = 3 + below(6);
    bridge.points_before = 2 + below(7);
    bridge.points_after = 1 + below(8);
    s.compensation.relock.method = static_cast<RelockMethod>(below(4));
    return s;
}

// Gaps of a gyro that has learnt its motion in the hundreds of ticks before.
Script estimated(std::string name, int gap_ticks, int light_samples, RelockMethod relock) {
    Script s = switching(std::move(name), gap_ticks, 20, light_samples, relock);
    s.halves = 2000;
    s.control.schedule.interval_ticks = 310;
    s.light_per_detuning = 1.0;
    s.control.mode_switch.lock_tolerance = core::Wavelengths{0.25};
    s.compensation.bridge.method = BridgeMethod::automatic;
    return s;
}

// The second gap begins before the first one is resolved; the sensor is dark in both.
Script crowded(int ticks_between, RelockMethod relock) {
    const char* name = relock == RelockMethod::joint ? "joint" : "auto";
    Script s = estimated(fmt::format("{}, two gaps, {} apart", name, ticks_between), 3, 64, relock);
    s.control.schedule.interval_ticks = 1'000'000;
    s.control.mode_switch.dark_ticks = s.control.mode_switch.lock_timeout_ticks = 1'000;
    s.ticks = repeated(lit, 700) + repeated(dark, 3) + repeated(lit, ticks_between) + repeated(dark, 3) + lit;
    s.halves = 1600;
    return s;
}

// The gap of a switch, and a dark tick so many ticks after the loop is closed: the switch is resolved while the profile
// of the detuning after the dark tick is made, or has no time left for its estimate.
Script interrupted(int gap_ticks, int ticks_between, RelockMethod relock) {
    const char* name = relock == RelockMethod::joint ? "joint" : "auto";
    Script s =
        estimated(fmt::format("{}, gap of {}, dark {} later", name, gap_ticks, ticks_between), gap_ticks, 64, relock);
    s.control.schedule.interval_ticks = 705;
    s.control.mode_switch.dark_ticks = s.control.mode_switch.lock_timeout_ticks = 1'000;
    s.ticks = repeated(lit, 705 + gap_ticks + ticks_between) + dark + lit;
    s.halves = 1600;
    return s;
}

// A gap before the motion is known; and another one so many ticks after it, or none.
Script first(int gap_ticks, int ticks_between, RelockMethod relock) {
    const char* name = relock == RelockMethod::joint ? "joint" : "auto";
    Script s = estimated(fmt::format("{}, first gap of {}{}", name, gap_ticks, ticks_between > 0 ? ", another" : ""),
                         gap_ticks, 64, relock);
    s.control.schedule.interval_ticks = 1'000'000;
    s.control.mode_switch.dark_ticks = s.control.mode_switch.lock_timeout_ticks = 1'000;
    const std::string gap = repeated(dark, gap_ticks);
    s.ticks = repeated(lit, 40) + gap + (ticks_between > 0 ? repeated(lit, ticks_between) + gap : "") + lit;
    s.halves = 200;
    return s;
}

void add_estimating(std::vector<Script>& all) {
    for (const int n : {2, 3, 8, 11, 15})
        all.push_back(estimated(fmt::format("auto, gap of {}", n), n, 16, RelockMethod::mean_square));
    for (const int n : {2, 3, 8})
        all.push_back(estimated(fmt::format("joint, gap of {}", n), n, 16, RelockMethod::joint));
    all.push_back(dithered(estimated("joint, 64 samples, shifted edges", 3, 64, RelockMethod::joint)));
    for (const RelockMethod relock : {RelockMethod::mean_square, RelockMethod::joint})
        for (const int ticks_between : {2, 5, 10}) all.push_back(dithered(crowded(ticks_between, relock)));
    for (const RelockMethod relock : {RelockMethod::mean_square, RelockMethod::joint}) {
        for (const int gap_ticks : {1, 3, 7, 15}) all.push_back(dithered(first(gap_ticks, 0, relock)));
        all.push_back(dithered(first(3, 10, relock)));
    }
    for (const int gap_ticks : {1, 3}) {
        all.push_back(dithered(interrupted(gap_ticks, 6, RelockMethod::mean_square)));
        all.push_back(dithered(interrupted(gap_ticks, 10, RelockMethod::joint)));
    }
}

void add_usual(std::vector<Script>& all) {
    for (const int n : {16, 64}) all.push_back(script(fmt::format("steady, {} samples", n), ".", 120, n));
    all.push_back(dithered(script("steady, 16 samples, shifted edges", ".", 120, 16)));
    all.push_back(script("steady, 16 samples of one beam", ".", 120, 16));
    all.back().one_beam = true;
    for (const int n : {1, 3, 16, 40})
        all.push_back(script(fmt::format("gap of {}", n), repeated(lit, 20) + repeated(dark, n) + lit, 200, 16));
    all.push_back(script("two gaps", repeated(lit, 20) + "xxx.xxx.", 120, 16));
    for (std::size_t k = 0; k < relock_names.size(); ++k)
        all.push_back(switching(fmt::format("switch, {}", relock_names[k]), 3, 20, 16, static_cast<RelockMethod>(k)));
    all.push_back(switching("switch, 64 samples", 3, 20, 64, RelockMethod::mean_square));
    all.push_back(dithered(switching("switch, 64 samples, shifted edges", 3, 20, 64, RelockMethod::mean_square)));
}

void add_worst(std::vector<Script>& all) {
    const std::string gap = repeated(lit, 12) + repeated(dark, 16);
    for (const char* after :
         {"........x", "........-", ".......x.", ".......-.", "......x..", "x.x.x.x.x", "...-....x"})
        all.push_back(with_most_points(script(fmt::format("16 by 16, {}", after), gap + after + lit, 120, 64)));
    // Wherever the lock comes relative to the tick that resolves the gap.
    for (int settle = 1; settle <= 10; ++settle)
        all.push_back(with_most_points(
            switching(fmt::format("16 by 16, lock {}", settle), 16, settle, 64, RelockMethod::frequency)));
    std::string alternating = repeated(lit, 12);
    for (int k = 0; k < 40; ++k) alternating += "x.";
    all.push_back(with_most_points(script("every second tick", alternating, 200, 64)));
    // A gap at the start waits longer: another one can be due in the same tick, or one tick before or after.
    for (int after = 1; after <= 6; ++after)
        for (int second = 6 - after; second <= 8 - after; ++second)
            for (const char tick : {lit, half_dark})
                if (second > 0)
                    all.push_back(with_most_points(
                        script(fmt::format("two due, {} of {}, {}", after, second, tick),
                               repeated(dark, 16) + lit + repeated(dark, second) + repeated(lit, after) + tick + lit,
                               80, 64),
                        after));
    for (std::uint32_t seed = 1; seed <= 8; ++seed) all.push_back(random(seed));
}

}  // namespace

std::vector<Script> scripts() {
    std::vector<Script> all;
    add_usual(all);
    add_worst(all);
    add_estimating(all);
    return all;
}

}  // namespace zlg::bench
