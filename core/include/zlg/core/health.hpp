#pragma once
// Health of the gyro in one half-period: a word of named bits.
//
// Bits say what was seen, half by half. They are not filtered, and no angle depends on them.

#include <array>
#include <cstdint>

namespace zlg::core {

enum HealthBit : std::uint32_t {
    health_frame_missed = 1u << 0,         // nothing was received; bits of measurements are 0
    health_sequence_error = 1u << 1,       // the frame's number does not follow
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
};

inline constexpr std::array<const char*, 16> health_bit_names{"frame_missed",
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
                                                              "half_wave_rejected"};

struct HealthConfig {
    std::int64_t counts_limit = 2000;  // per half: bias plus the highest rate of rotation, > 0
};

enum class HealthFault : unsigned char { none, counts_limit };

[[nodiscard]] constexpr HealthFault check(const HealthConfig& c) noexcept {
    return c.counts_limit > 0 ? HealthFault::none : HealthFault::counts_limit;
}

// What the other parts report of one half; false is the good answer of each.
struct HealthReport {
    bool frame_missed = false;
    bool sequence_error = false;
    bool sign_error = false;
    bool timer_error = false;
    bool echo_error = false;
    bool light_lost = false;
    bool light_unusable = false;
    bool detuning_over_limit = false;
    bool piezo_near_range_end = false;
    bool piezo_not_finite = false;
    bool temperature_not_finite = false;
    bool switching = false;
    bool relock_failed = false;
    bool searching = false;
    bool half_wave_rejected = false;
    std::int64_t counts = 0;  // of the half, as read
};

// The word of bits for one half. config passed `check`.
[[nodiscard]] std::uint32_t health_bits(const HealthConfig& config, const HealthReport& report) noexcept;

}  // namespace zlg::core
