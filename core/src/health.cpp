#include <zlg/core/health.hpp>

namespace zlg::core {

std::uint32_t health_bits(const HealthConfig& config, const HealthReport& r) noexcept {
    const bool counter_jump = r.counts > config.counts_limit || r.counts < -config.counts_limit;
    std::uint32_t bits = 0;
    if (r.frame_missed) bits |= health_frame_missed;
    if (r.sequence_error) bits |= health_sequence_error;
    if (r.sign_error) bits |= health_sign_error;
    if (r.timer_error) bits |= health_timer_error;
    if (r.echo_error) bits |= health_echo_error;
    if (r.light_lost) bits |= health_light_lost;
    if (r.light_unusable) bits |= health_light_unusable;
    if (r.detuning_over_limit) bits |= health_detuning_over_limit;
    if (r.piezo_near_range_end) bits |= health_piezo_near_range_end;
    if (r.piezo_not_finite) bits |= health_piezo_not_finite;
    if (r.temperature_not_finite) bits |= health_temperature_not_finite;
    if (r.switching) bits |= health_switching;
    if (r.relock_failed) bits |= health_relock_failed;
    if (r.searching) bits |= health_searching;
    if (counter_jump) bits |= health_counter_jump;
    if (r.half_wave_rejected) bits |= health_half_wave_rejected;
    return bits;
}

}  // namespace zlg::core
