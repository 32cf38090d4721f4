#pragma once
// Health of the gyro in one half-period: a word of named bits.
//
// Bits report what was observed in a half. Whether the half is valid is decided by the monitors; no angle depends on
// the word.

#include <array>
#include <cstdint>

namespace zlg::core {

// The bits from the lowest on.
// clang-format off
#define ZLG_HEALTH_BITS(BIT)                                                                            \
    BIT(frame_missed) /* nothing was received; bits of measurements are 0 */                            \
    BIT(sequence_error) /* the frame is of another half, or follows none; bits of measurements are 0 */ \
    BIT(sign_error) /* the bias sign's echo does not alternate */                                       \
    BIT(timer_error) /* the stamp does not advance by the nominal half */                               \
    BIT(echo_error) /* polarity or loop state in force was not what was commanded */                    \
    BIT(light_lost) /* not in both directions throughout the half */                                    \
    BIT(light_unusable) /* no samples, or some not finite */                                            \
    BIT(detuning_over_limit) /* in a closed loop */                                                     \
    BIT(piezo_near_range_end)                                                                           \
    BIT(piezo_not_finite)                                                                               \
    BIT(temperature_not_finite)                                                                         \
    BIT(switching) /* a change of mode is under way, up to its lock */                                  \
    BIT(relock_failed) /* on the way back after no lock, or searching */                                \
    BIT(searching)                                                                                      \
    BIT(counter_jump) /* more counts than any rotation allowed can bring */                             \
    BIT(half_wave_rejected) /* the last switch measured no half-wave voltage, or an outlier */          \
    BIT(rate_over_range) /* so many counts half after half */                                           \
    BIT(counter_bit_stuck) /* no count can be trusted */                                                \
    BIT(bias_lost) /* the counter does not show the bias of this gyro */                                \
    BIT(helicity_reversed) /* it shows that of the other mode */                                        \
    BIT(coil_current) /* not what it was, or not the same in both signs */                              \
    BIT(rate_near_bias) /* static lock-in: the rotation nearly cancels the bias in one sign */          \
    BIT(light_stuck) /* a converter of light shows the same number, over and over */                    \
    BIT(light_noisy) /* far more than the noise it should have */                                       \
    BIT(light_unbalanced) /* one beam has faded against the other */                                    \
    BIT(light_contradicted) /* the beat proves the light that the photodiodes do not show */            \
    BIT(detuning_unsteady) /* a motion of the perimeter left a false angle in the tick */               \
    BIT(recentring) /* the switch under way, or the last one, led away from an end of the range */      \
    BIT(warming_up) /* the temperature changes, and what depends on it */                               \
    BIT(edges_shifted) /* the reversals are dithered against lock-in */                                 \
    BIT(fringe_lost) /* the phase of the fringe is to be read and cannot be trusted: whole counts */    \
    BIT(fringe_skewed) /* its photodiodes are not sampled at the latch */

// clang-format on
#define ZLG_PLACE(name) place_of_##name,
#define ZLG_BIT(name) health_##name = 1u << place_of_##name,
#define ZLG_NAME(name) #name,
enum HealthPlace : unsigned { ZLG_HEALTH_BITS(ZLG_PLACE) };
enum HealthBit : std::uint32_t { ZLG_HEALTH_BITS(ZLG_BIT) };
inline constexpr std::array health_bit_names{ZLG_HEALTH_BITS(ZLG_NAME)};
#undef ZLG_HEALTH_BITS
#undef ZLG_PLACE
#undef ZLG_BIT
#undef ZLG_NAME

}  // namespace zlg::core
