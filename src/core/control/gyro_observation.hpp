#pragma once
// What one frame shows, before anything is decided.

#include <cstdint>

#include <zlg/core/control/gyro_control_state.hpp>
#include <zlg/core/records.hpp>

namespace zlg::core {

struct Observation {
    bool received = false;
    FrameOrderOutput order;  // fresh: everything below rests on it
    bool counted = false;    // `counts` are those of this half
    bool polarity_error = false;
    bool echo_error = false;
    bool bit_stuck = false;  // of the counter
    bool lit = false;        // there was light in both directions, or the beat proves it
    bool valid = false;
    bool steady = false;    // both beams were lit and steady throughout, in the mode of the record
    bool unsteady = false;  // the tick holds a false angle
    bool beyond = false;    // the counts are more than the gyro can make
    bool lased = false;     // lit, in a closed loop
    std::int8_t polarity = 1;
    std::int8_t beat_sign = 1;  // of the bias beat: bias sign times helicity
    bool loop_closed = true;
    bool settled = false;  // and locked
    FringeReadoutOutput fringe;
    std::int64_t counts = 0;
    double real_counts = 0.0;  // the same number
    double max_counts = 0.0;   // of a half of this length
    ReadingMonitorOutput reading;
    bool left_to_next = false;  // its counts are part of those of the next valid half
    BiasCommutatorOutput commuted;
    BiasMonitorOutput bias;
    bool bias_wrong = false;
    CoilMonitorOutput coil;
    SyncDetectorOutput light;
    LightMonitorOutput monitored;
    bool has_mean_square = false;  // to be recorded
    Volts piezo{not_a_number};
    double temperature_c = not_a_number;

    // Of what was decided on it.
    SwitchPhase phase = SwitchPhase::tracking;  // of the half itself
    bool over_limit = false;                    // of the perimeter loop
    bool near_range_end = false;
    bool half_wave_rejected = false;  // of a switch that has ended
    bool warms_up = false;
};

// Read the frame that is latched now: all states but those of what decides and commands.
void observe(const GyroControlConfig& config, GyroControlState& state, const SensorFrame& frame,
             Observation& seen) noexcept;

}  // namespace zlg::core
