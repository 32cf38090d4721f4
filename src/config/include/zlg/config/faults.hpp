#pragma once
// The section [faults]: what breaks in a simulated gyro.

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace zlg::config {

// By the names that the twin gives to its faults, in its order.
enum class FaultKind {
    laser_off,
    beam_fades,
    mode_hop,
    switch_wrong_mode,
    switch_no_mode,
    half_wave_error,
    perimeter_ramp,
    piezo_step,
    light_stuck,
    light_noisy,
    light_saturated,
    light_nan,
    piezo_adc_stuck,
    piezo_adc_nan,
    temperature_nan,
    counter_bit_stuck,
    frame_missed,
    frame_repeated,
    frame_late,
    bias_lost,
    bias_asymmetric,
    field_pulse,
    thermal_shock,
    vibration,
    shock,
    overspeed,
};

inline constexpr std::array<std::string_view, 26> fault_kind_names{
    "laser_off",       "beam_fades",    "mode_hop",        "switch_wrong_mode", "switch_no_mode",  "half_wave_error",
    "perimeter_ramp",  "piezo_step",    "light_stuck",     "light_noisy",       "light_saturated", "light_nan",
    "piezo_adc_stuck", "piezo_adc_nan", "temperature_nan", "counter_bit_stuck", "frame_missed",    "frame_repeated",
    "frame_late",      "bias_lost",     "bias_asymmetric", "field_pulse",       "thermal_shock",   "vibration",
    "shock",           "overspeed"};

struct Faults {
    // Fault number i is kind[i] from at_s[i] on.
    std::vector<FaultKind> kind;
    std::vector<double> at_s;
    std::vector<double> duration_s;
    std::vector<double> size;  // in the unit of its kind
    double vibration_hz = 170.0;
    double random_per_hour = 0.0;
    std::int64_t random_seed = 1;
    std::vector<FaultKind> random_kinds;  // none: all
};

}  // namespace zlg::config
