#pragma once
// Control and a small plant in closed loop, with either perimeter loop.

#include <zlg/core/gyro_control.hpp>

#include "small_plant.hpp"
#include "support.hpp"

namespace zlg::core::test {

constexpr GyroControlConfig config_with(auto change) {
    GyroControlConfig c;
    c.schedule.interval_ticks = 200;
    c.mode_switch.start_set_point = Volts{160.0};
    change(c);
    return c;
}
constexpr GyroControlConfig config_of(LoopKind kind) {
    return config_with([kind](GyroControlConfig& c) { c.loop.kind = kind; });
}

constexpr GyroControlConfig dithered(LoopKind kind, DitherMethod method) {
    return config_with([&](GyroControlConfig& c) {
        c.loop.kind = kind;
        c.commutator.dither.method = method;
    });
}

inline bool all_finite(const HalfRecord& r) {
    return std::isfinite(r.detuning_lambda) && std::isfinite(r.detuning_sq_lambda2) && std::isfinite(r.piezo_v) &&
           std::isfinite(r.temperature_c);
}

inline void scale_light(SensorFrame& f, float part) {
    for (float& x : f.light_a) x *= part;
    for (float& x : f.light_b) x *= part;
}
inline void add_noise(SensorFrame& f, auto& random, float part) {
    std::normal_distribution<float> normal;
    for (float& x : f.light_a) x *= 1.0f + part * normal(random);
    for (float& x : f.light_b) x *= 1.0f + part * normal(random);
}

// Control and a plant in closed loop; frames can be spoilt between the two.
class Loop {
public:
    explicit Loop(const GyroControlConfig& c, std::uint64_t counter = 0) : plant{c.loop.kind}, config{c} {
        plant.counter = counter;
        state = initial_state(c, counter);
        actuator = initial_actuator(c);
    }

    template <class Spoil> const GyroControlOutput& half(Spoil spoil) {
        SensorFrame frame = plant.advance(actuator);
        spoil(frame);
        out = step(config, state, frame);
        actuator = out.actuator;
        records.push_back(out.record);
        health.push_back(out.health);
        seen |= out.health;
        if (out.has_event) events.push_back(out.event);
        return out;
    }
    const GyroControlOutput& half() {
        return half([](SensorFrame&) {});
    }
    template <class Spoil> void ticks(int n, Spoil spoil) {
        for (int k = 0; k < 2 * n; ++k) (void)half(spoil);
    }
    void ticks(int n) {
        ticks(n, [](SensorFrame&) {});
    }

    // First half of every run of open halves, and its length.
    [[nodiscard]] std::vector<std::pair<std::int64_t, int>> open_runs() const {
        std::vector<std::pair<std::int64_t, int>> runs;
        for (std::size_t h = 0; h < records.size(); ++h) {
            if (records[h].loop_closed) continue;
            if (h == 0 || records[h - 1].loop_closed) runs.emplace_back(records[h].half, 0);
            ++runs.back().second;
        }
        return runs;
    }
    // Halves that were not valid since the last call, and no longer remembered.
    int invalid() {
        int n = 0;
        for (const HalfRecord& r : records) n += !r.valid;
        records.clear();
        return n;
    }
    [[nodiscard]] bool tracks() const { return state.mode_switch.phase == SwitchPhase::tracking; }

    SmallPlant plant;
    GyroControlConfig config;
    GyroControlState state;
    ActuatorFrame actuator;
    GyroControlOutput out;
    std::vector<HalfRecord> records;
    std::vector<std::uint32_t> health;
    std::uint32_t seen = 0;  // of the health, in all halves
    std::vector<SwitchEvent> events;
};

// Instantiated in gyro_control_test.cpp, as GyroControl/EitherLoop.
struct EitherLoop : testing::TestWithParam<LoopKind> {
    Loop loop{config_of(GetParam())};
};

}  // namespace zlg::core::test
