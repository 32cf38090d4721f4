#pragma once
// The kinds of faults of a gyro: their names and what is to be known of each, in one table.

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <type_traits>

namespace zlg::twin {

enum class FaultKind : unsigned char {
    laser_off,          // no light in either beam
    beam_fades,         // beam A sinks to 1 - size at half of the time and comes back
    mode_hop,           // the perimeter changes by size, wavelengths, within the time; it stays so
    switch_wrong_mode,  // a loop that opens in this time is sent size wavelengths off: about 0.5
    switch_no_mode,     // the same: about 0.25, between two modes
    half_wave_error,    // the half-wave voltage is 1 + size times its own
    perimeter_ramp,     // the perimeter grows by size wavelengths a second; what it gained stays
    piezo_step,         // the piezo lengthens by size wavelengths within the time; it stays so
    light_stuck,        // a converter of light keeps its last code; size 0: beam A, 1: B, 2: both
    light_noisy,        // noise of both, standard deviation of size times the light at the centre
    light_saturated,    // both end at size times the light at the centre
    light_nan,
    piezo_adc_stuck,
    piezo_adc_nan,
    temperature_nan,
    counter_bit_stuck,  // bit number size reads 1
    frame_missed,
    frame_repeated,   // the last frame before again, with its sequence number
    frame_late,       // by one half: the first is missed, each next one is that of the half before, the last is lost
    bias_lost,        // the bias current is 1 - size times its own
    bias_asymmetric,  // 1 + size times in halves of positive sign, 1 - size times in the others
    field_pulse,      // a constant field: size counts a second more in the left mode and fewer in the right one
    thermal_shock,    // the gyro warms by size degrees within the time; it stays so
    vibration,        // the perimeter swings by size wavelengths at vibration_hz
    shock,            // the perimeter bulges by size wavelengths, a half-sine over the time
    overspeed,        // the case turns faster, by size arcsec/s at half of the time
};

inline constexpr double default_vibration_hz = 170.0;

// What a fault acts on. The exponential loop is a formula that knows none of the first three.
enum class FaultActs { light, length, loop, elsewhere };

struct FaultBounds {
    double least = 0.0;
    double most = 0.0;
};

struct FaultFacts {
    FaultKind kind;
    std::string_view name;
    std::string_view unit{};  // of size; empty where it has none, or where it is a ratio or a number
    FaultActs acts_on = FaultActs::elsewhere;
    bool is_whole = false;        // the size is a whole number
    FaultBounds size{-1e9, 1e9};  // allowed
    FaultBounds random_size{};    // of a random one, evenly: large enough to matter, small enough to survive
    bool either_sign = false;     // a random one may be negative
    FaultBounds random_s;         // duration of a random one, evenly in its logarithm
};

// A row for each kind, in the order of the enumeration.
inline constexpr auto fault_table = [] {
    using enum FaultKind;
    using enum FaultActs;
    // clang-format off
    return std::to_array<FaultFacts>({
        {.kind = laser_off, .name = "laser_off", .acts_on = light, .random_s = {0.02, 1.0}},
        {.kind = beam_fades, .name = "beam_fades", .acts_on = light, .size = {0.0, 1.0},
         .random_size = {0.3, 1.0}, .random_s = {0.1, 1.0}},
        {.kind = mode_hop, .name = "mode_hop", .unit = "lambda", .acts_on = length, .size = {-10.0, 10.0},
         .random_size = {0.45, 0.55}, .either_sign = true, .random_s = {0.0005, 0.005}},
        {.kind = switch_wrong_mode, .name = "switch_wrong_mode", .unit = "lambda", .acts_on = loop,
         .size = {-10.0, 10.0}, .random_size = {0.45, 0.55}, .either_sign = true, .random_s = {1.0, 4.0}},
        {.kind = switch_no_mode, .name = "switch_no_mode", .unit = "lambda", .acts_on = loop, .size = {-10.0, 10.0},
         .random_size = {0.22, 0.28}, .either_sign = true, .random_s = {1.0, 4.0}},
        {.kind = half_wave_error, .name = "half_wave_error", .acts_on = loop, .size = {-0.9, 10.0},
         .random_size = {0.1, 0.2}, .either_sign = true, .random_s = {2.0, 5.0}},
        {.kind = perimeter_ramp, .name = "perimeter_ramp", .unit = "lambda/s", .acts_on = length,
         .size = {-100.0, 100.0}, .random_size = {0.3, 0.8}, .either_sign = true, .random_s = {3.0, 5.0}},
        {.kind = piezo_step, .name = "piezo_step", .unit = "lambda", .acts_on = length, .size = {-10.0, 10.0},
         .random_size = {0.02, 0.15}, .either_sign = true, .random_s = {0.001, 0.3}},
        {.kind = light_stuck, .name = "light_stuck", .is_whole = true, .size = {0.0, 2.0},
         .random_size = {0.0, 2.0}, .random_s = {0.02, 1.0}},
        {.kind = light_noisy, .name = "light_noisy", .size = {0.0, 1e9},
         .random_size = {0.02, 0.5}, .random_s = {0.02, 1.0}},
        {.kind = light_saturated, .name = "light_saturated", .size = {0.0, 1e9},
         .random_size = {0.3, 0.95}, .random_s = {0.02, 1.0}},
        {.kind = light_nan, .name = "light_nan", .random_s = {0.001, 1.0}},
        {.kind = piezo_adc_stuck, .name = "piezo_adc_stuck", .random_s = {0.02, 4.0}},
        {.kind = piezo_adc_nan, .name = "piezo_adc_nan", .random_s = {0.02, 4.0}},
        {.kind = temperature_nan, .name = "temperature_nan", .random_s = {0.02, 4.0}},
        {.kind = counter_bit_stuck, .name = "counter_bit_stuck", .is_whole = true, .size = {0.0, 63.0},
         .random_size = {0.0, 12.0}, .random_s = {0.02, 1.0}},
        {.kind = frame_missed, .name = "frame_missed", .random_s = {0.0025, 0.25}},
        {.kind = frame_repeated, .name = "frame_repeated", .random_s = {0.0025, 0.25}},
        {.kind = frame_late, .name = "frame_late", .random_s = {0.0025, 0.25}},
        {.kind = bias_lost, .name = "bias_lost", .size = {0.0, 1.0},
         .random_size = {0.02, 1.0}, .random_s = {0.02, 1.0}},
        {.kind = bias_asymmetric, .name = "bias_asymmetric", .size = {-1.0, 1.0},
         .random_size = {0.003, 0.1}, .either_sign = true, .random_s = {0.02, 1.0}},
        {.kind = field_pulse, .name = "field_pulse", .unit = "counts/s", .size = {-1e6, 1e6},
         .random_size = {0.3, 30.0}, .either_sign = true, .random_s = {0.1, 2.0}},
        {.kind = thermal_shock, .name = "thermal_shock", .unit = "C", .acts_on = loop, .size = {-1000.0, 1000.0},
         .random_size = {5.0, 30.0}, .either_sign = true, .random_s = {0.5, 3.0}},
        {.kind = vibration, .name = "vibration", .unit = "lambda", .acts_on = length, .size = {-10.0, 10.0},
         .random_size = {0.005, 0.1}, .random_s = {0.2, 2.0}},
        {.kind = shock, .name = "shock", .unit = "lambda", .acts_on = length, .size = {-10.0, 10.0},
         .random_size = {0.02, 0.3}, .either_sign = true, .random_s = {0.003, 0.02}},
        {.kind = overspeed, .name = "overspeed", .unit = "arcsec/s",
         .random_size = {1.6e6, 3e6}, .either_sign = true, .random_s = {1.5, 3.0}},
    });
    // clang-format on
}();

inline constexpr std::size_t n_fault_kinds = fault_table.size();

// Row by row the kinds themselves.
static_assert([] {
    std::size_t n = 0;
    return std::all_of(fault_table.begin(), fault_table.end(),
                       [&](const FaultFacts& row) { return static_cast<std::size_t>(row.kind) == n++; });
}());

[[nodiscard]] constexpr const FaultFacts& facts(FaultKind kind) {
    return fault_table.at(static_cast<std::size_t>(kind));
}

template <auto Fact> [[nodiscard]] constexpr auto of_all_kinds() {
    std::array<std::remove_cvref_t<decltype(fault_table[0].*Fact)>, n_fault_kinds> values{};
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = fault_table[k].*Fact;
    return values;
}

inline constexpr auto all_fault_kinds = of_all_kinds<&FaultFacts::kind>();
inline constexpr auto fault_kind_names = of_all_kinds<&FaultFacts::name>();

}  // namespace zlg::twin
