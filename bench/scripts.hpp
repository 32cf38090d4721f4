#pragma once
// The scripts under which the core's instructions are counted: the usual operation of a gyro, and the worst cases; and
// a gyro that does what a script says, to lead the core into each of its paths: no physics, only frames.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <zlg/core/gyro_compensation.hpp>
#include <zlg/core/gyro_control.hpp>

namespace zlg::bench {

// One tick of a script, the last of which goes on for ever.
//
//   '.'  light in both directions      'x'  dark in both halves      '-'  dark in the second half
inline constexpr char lit = '.';
inline constexpr char dark = 'x';
inline constexpr char half_dark = '-';

struct Script {
    std::string name;
    std::string ticks;
    int halves = 0;
    std::uint8_t light_samples = 16;
    bool one_beam = false;
    double light_per_detuning = 0.05;  // what the light shows of it: little, so that the loop stays locked
    core::GyroControlConfig control{};
    core::GyroCompensationConfig compensation{};
};

class ScriptedGyro {
public:
    explicit ScriptedGyro(const Script& script) : script_{script} {}

    core::SensorFrame advance(const core::ActuatorFrame& actuator) {
        if (actuator.loop_closed) {
            detuning_lambda_ *= 0.98;  // slow: `frequency` finds a decay in each of its ticks
            voltage_v_ += 0.1 * (actuator.set_point_v[0] - voltage_v_);
        } else {
            detuning_lambda_ = 0.2;
            voltage_v_ = actuator.set_point_v[0];
        }
        const bool is_dark = darkness();
        if (is_dark) detuning_lambda_ = 0.2;
        core::SensorFrame frame = stamped(actuator);
        shine(frame, is_dark);
        ++half_;
        return frame;
    }

private:
    [[nodiscard]] bool darkness() const {
        const auto tick = static_cast<std::size_t>(half_ / 2);
        const char now = tick < script_.ticks.size() ? script_.ticks[tick] : script_.ticks.back();
        return now == dark || (now == half_dark && half_ % 2 != 0);
    }

    core::SensorFrame stamped(const core::ActuatorFrame& actuator) {
        core::SensorFrame frame;
        frame.sequence = static_cast<std::uint32_t>(half_);
        frame.timer_ticks = static_cast<std::uint64_t>(25000 * std::int64_t{half_ + 1} + actuator.edge_offset_ticks);
        frame.bias_sign = half_ % 2 == 0 ? std::int8_t{1} : std::int8_t{-1};
        frame.polarity = actuator.polarity;
        frame.loop_closed = actuator.loop_closed;
        const double bias = 150.0 * (1.0 - 3.6 * detuning_lambda_ * detuning_lambda_);
        counter_ += static_cast<std::uint64_t>(
            static_cast<std::int64_t>(300.0 * std::sin(0.01 * half_) + frame.bias_sign * frame.polarity * bias));
        frame.counter = counter_;
        frame.piezo_v = voltage_v_;
        frame.coil_current_a = frame.bias_sign;
        frame.temperature_c = 20.0;
        return frame;
    }

    // Uniform, of unit variance.
    double noise() {
        random_ = 1664525u * random_ + 1013904223u;
        return std::sqrt(12.0) * (static_cast<double>(random_ >> 8) / 16777216.0 - 0.5);
    }

    void shine(core::SensorFrame& frame, bool is_dark) {
        const double level = is_dark ? 0.0 : 1000.0;
        const int sign = frame.bias_sign * frame.polarity;
        frame.n_light = script_.light_samples;
        frame.has_light_b = !script_.one_beam;
        for (std::size_t k = 0; k < script_.light_samples; ++k) {
            // Decays on within the half, with noise of the size that the core presumes.
            const double gone = 0.02 * (static_cast<double>(k) + 0.5) / script_.light_samples;
            const double detuning_lambda = script_.light_per_detuning * detuning_lambda_ * (1.0 - gone);
            const double signal = 0.332 * (sign * detuning_lambda + 0.0033 * noise());
            frame.light_a[k] = static_cast<float>(level * (1.0 + signal));
            frame.light_b[k] = static_cast<float>(level * (1.0 - signal));
        }
    }

    const Script& script_;
    int half_ = 0;
    double detuning_lambda_ = 0.2;
    double voltage_v_ = 150.0;
    std::uint64_t counter_ = 0;
    std::uint32_t random_ = 1;
};

// First the usual ones, then the worst with the methods of the paper, then those with the optimal bridge and the joint
// re-lock, whose halves cost more.
[[nodiscard]] std::vector<Script> scripts();

}  // namespace zlg::bench
