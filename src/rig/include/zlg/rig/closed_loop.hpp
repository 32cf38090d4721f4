#pragma once
// The loop of twin and control, one half-period at a time.

#include <cstdint>
#include <limits>
#include <optional>

#include <zlg/config/config.hpp>
#include <zlg/core/gyro_compensation.hpp>
#include <zlg/core/gyro_control.hpp>
#include <zlg/core/records.hpp>
#include <zlg/rig/leap.hpp>
#include <zlg/rig/measured_half_wave.hpp>
#include <zlg/rig/processor.hpp>
#include <zlg/rig/replay.hpp>
#include <zlg/twin/twin.hpp>

namespace zlg::rig {

struct LoopHalf {
    core::HalfRecord record{};          // what the raw log holds
    core::GyroControlOutput control{};  // health and switch events beside it
    twin::TwinTruth truth{};            // what no gyro knows
    double half_wave_v = 0.0;           // U_lambda/2 as the switches measured it, and its standard deviation
    double half_wave_sigma_v = 0.0;
    std::optional<core::CompensationOutput> compensation{};  // of a processor outside, which runs it as well
};

class ClosedLoop {
public:
    // processor  runs the core in place of this program, and outlives the loop; null: this program runs it.
    //
    // errors  config::ConfigError where the configuration does not make a gyro, or the run is longer than the motion;
    //         those of the processor, here and in the other functions.
    ClosedLoop(const config::Config& config, twin::Motion motion, Processor* processor = nullptr);

    LoopHalf advance();

    // Of fidelity `events`, where it is quiet here and the next event is far: a leap towards it. To be asked before
    // each tick, until there is none; then a tick is to be lived.
    //
    // most_halves    until the end of the run.
    // longest_ticks  of a single leap: points of the error in time.
    std::optional<Leap> leap(std::int64_t most_halves,
                             std::int64_t longest_ticks = std::numeric_limits<std::int64_t>::max());

    // The light samples of the half before, until the next `advance`.
    [[nodiscard]] core::LightSamples light() const;

    // The sensor frame of the half before; and the control, where this program runs it.
    [[nodiscard]] const core::SensorFrame& sensor() const { return *sensor_; }
    [[nodiscard]] const core::GyroControlState& control() const { return control_state_; }

private:
    [[nodiscard]] std::int64_t quiet_ticks(std::int64_t most_halves);
    LoopHalf step_here();
    LoopHalf step_outside();

    config::Config config_;         // for messages
    std::optional<LeapPlan> plan_;  // of a gyro that leaps
    twin::Twin twin_;
    core::GyroControlConfig control_config_;
    core::GyroControlState control_state_;
    core::ActuatorFrame actuator_;
    MeasuredHalfWave half_wave_;
    const core::SensorFrame* sensor_;  // of the twin, which keeps its place
    core::HalfRecord last_{};          // of the half before
    std::int64_t piece_ticks_ = 0;     // of the leaps up to the next event
    std::int64_t learn_ticks_ = 0;     // before it
    bool has_leapt_ = false;
    std::optional<Replay> adviser_;  // compensation beside the control, for a schedule that asks for what is measured
    Processor* processor_;
};

}  // namespace zlg::rig
