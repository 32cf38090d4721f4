#pragma once
// Faults of a gyro: what breaks, when, for how long and how badly.
//
// Plain data. What a fault does is a function of time alone, so that a run with the same faults is the same run. The
// physical ones change light, perimeter, bias or motion and reach the processor only through what it measures; those of
// converters, counter and frames change what is latched or delivered.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

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
    field_pulse,  // a constant field that adds size Hz to the fringe rate of the left mode and takes it from the right
    thermal_shock,  // the gyro warms by size degrees within the time; it stays so
    vibration,      // the perimeter swings by size wavelengths at vibration_hz
    shock,          // the perimeter bulges by size wavelengths, a half-sine over the time
    overspeed,      // the case turns faster, by size arcsec/s at half of the time
};

inline constexpr std::size_t n_fault_kinds = 26;

struct Fault {
    FaultKind kind = FaultKind::laser_off;
    double at_s = 0.0;
    double duration_s = 0.0;
    double size = 0.0;  // in the unit of its kind; nothing to those that have none
};

// What is to be known of a kind.
struct FaultFacts {
    std::string_view name;
    std::string_view unit;  // of size; empty where it has none, or where it is a ratio or a number
    double min_size;        // allowed
    double max_size;
    double least_size;  // of a random one, evenly up to `most_size`
    double most_size;
    bool either_sign;  // a random one may be negative
    double least_s;    // and lasts so long, evenly in its logarithm up to `most_s`
    double most_s;
};

[[nodiscard]] const FaultFacts& facts(FaultKind kind);

[[nodiscard]] constexpr std::array<FaultKind, n_fault_kinds> all_fault_kinds() {
    std::array<FaultKind, n_fault_kinds> kinds{};
    for (std::size_t k = 0; k < n_fault_kinds; ++k) kinds[k] = static_cast<FaultKind>(k);
    return kinds;
}

// One fault of a kind, with duration and size as the seed draws them.
[[nodiscard]] Fault random_fault(FaultKind kind, double at_s, std::uint64_t seed);

// Faults at random moments from 0 to `until_s`, `per_hour` of them an hour on average, in the order of their start; the
// kinds equally often, all of them where `kinds` is empty.
//
// errors  std::invalid_argument for a rate or an end that is negative or not finite, or a million faults or more.
[[nodiscard]] std::vector<Fault> random_faults(double per_hour, double until_s, std::uint64_t seed,
                                               std::span<const FaultKind> kinds);

}  // namespace zlg::twin
