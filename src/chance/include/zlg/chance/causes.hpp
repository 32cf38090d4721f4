#pragma once
// What a random number is drawn for. Two causes never share a number, so that drawing more for one changes no other.
//
// All causes stand here, so that no two users take the same by accident. A new one goes to the end of its
// range, and none is taken away: the numbers of the others would change, and with them the runs of a seed.

#include <cstdint>

namespace zlg::chance {

enum class Cause : std::uint16_t {
    // 0x0000..0x00ff: the twin
    light = 0x0001,
    random_walk,
    adc,
    dark_counts,
    start_phase,
    coil,
    fringe,
    fringe_jitter,
    leap,
    quantum,

    // 0x0100..0x01ff: its faults
    faults = 0x0100,
    fault_times,
    faulty_light,

    // 0x0200..0x02ff: the paper recomputed
    phase_at_switch = 0x0200,

    // 0x0300..0x03ff: many gyros
    sweep_seed = 0x0300,
    sweep_parameter,
    sweep_order,
    sweep_shift,

    // 0x8000..0xffff: campaigns, benchmarks and tests
    synthetic_motion = 0x8000,
    synthetic_gyro,
    vehicle,
    vehicle_motion,
    manoeuvre,
    manoeuvre_step,
    switch_start,
    switch_opening,
    sigma_gyro,
    gap_gyro,
    field_pulse,
    drift_motion,
    noise_gyro,
    noise_record,
    deviation_record,
    magnetic_base,
    magnetic_walk,
    magnetic_end,
    scenario,
    fault_trial,
    random_gyro,
    wire_damage,
    event_gyro,
    environment,
    benchmark = 0xfffe,
    test = 0xffff,
};

}  // namespace zlg::chance
