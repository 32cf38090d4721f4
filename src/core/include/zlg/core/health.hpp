#pragma once
// Health of the gyro in one half-period: a word of named bits.
//
// Bits report what was observed in a half. Whether the half is valid is decided by the monitors; no angle depends on
// the word.

#include <array>
#include <cstdint>

namespace zlg::core {

enum HealthBit : std::uint32_t {
    health_frame_missed = 1u << 0,         // nothing was received; bits of measurements are 0
    health_sequence_error = 1u << 1,       // the frame is of another half, or follows none; bits of measurements are 0
    health_sign_error = 1u << 2,           // the bias sign's echo does not alternate
    health_timer_error = 1u << 3,          // the stamp does not advance by the nominal half
    health_echo_error = 1u << 4,           // polarity or loop state in force was not what was commanded
    health_light_lost = 1u << 5,           // not in both directions throughout the half
    health_light_unusable = 1u << 6,       // no samples, or some not finite
    health_detuning_over_limit = 1u << 7,  // in a closed loop
    health_piezo_near_range_end = 1u << 8,
    health_piezo_not_finite = 1u << 9,
    health_temperature_not_finite = 1u << 10,
    health_switching = 1u << 11,      // a change of mode is under way, up to its lock
    health_relock_failed = 1u << 12,  // on the way back after no lock, or searching
    health_searching = 1u << 13,
    health_counter_jump = 1u << 14,        // more counts than any rotation allowed can bring
    health_half_wave_rejected = 1u << 15,  // the last switch measured no half-wave voltage, or an outlier
    health_rate_over_range = 1u << 16,     // so many counts half after half
    health_counter_bit_stuck = 1u << 17,   // no count can be trusted
    health_bias_lost = 1u << 18,           // the counter does not show the bias of this gyro
    health_helicity_reversed = 1u << 19,   // it shows that of the other mode
    health_coil_current = 1u << 20,        // not what it was, or not the same in both signs
    health_rate_near_bias = 1u << 21,      // static lock-in: the rotation nearly cancels the bias in one sign
    health_light_stuck = 1u << 22,         // a converter of light shows the same number, over and over
    health_light_noisy = 1u << 23,         // far more than the noise it should have
    health_light_unbalanced = 1u << 24,    // one beam has faded against the other
    health_light_contradicted = 1u << 25,  // the beat proves the light that the photodiodes do not show
    health_detuning_unsteady = 1u << 26,   // a motion of the perimeter left a false angle in the tick
    health_recentring = 1u << 27,          // the switch under way, or the last one, led away from an end of the range
    health_warming_up = 1u << 28,          // the temperature changes, and what depends on it
    health_edges_shifted = 1u << 29,       // the reversals are dithered against lock-in
    health_fringe_lost = 1u << 30,         // the phase of the fringe is to be read and cannot be trusted: whole counts
    health_fringe_skewed = 1u << 31,       // its photodiodes are not sampled at the latch
};

inline constexpr std::array<const char*, 32> health_bit_names{"frame_missed",
                                                              "sequence_error",
                                                              "sign_error",
                                                              "timer_error",
                                                              "echo_error",
                                                              "light_lost",
                                                              "light_unusable",
                                                              "detuning_over_limit",
                                                              "piezo_near_range_end",
                                                              "piezo_not_finite",
                                                              "temperature_not_finite",
                                                              "switching",
                                                              "relock_failed",
                                                              "searching",
                                                              "counter_jump",
                                                              "half_wave_rejected",
                                                              "rate_over_range",
                                                              "counter_bit_stuck",
                                                              "bias_lost",
                                                              "helicity_reversed",
                                                              "coil_current",
                                                              "rate_near_bias",
                                                              "light_stuck",
                                                              "light_noisy",
                                                              "light_unbalanced",
                                                              "light_contradicted",
                                                              "detuning_unsteady",
                                                              "recentring",
                                                              "warming_up",
                                                              "edges_shifted",
                                                              "fringe_lost",
                                                              "fringe_skewed"};

}  // namespace zlg::core
