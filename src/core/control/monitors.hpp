#pragma once
// The table of monitors: the bit that reports what is watched in a half, what the half loses by it, and where it is
// seen.
//
// A new monitor is a row; where it needs a memory, a module fills in the observation, and holds limit and debounce.

#include <cstdint>

#include <zlg/core/common/maths.hpp>
#include <zlg/core/health.hpp>

#include "gyro_observation.hpp"

namespace zlg::core {

enum class Loses : unsigned char {
    nothing,
    light,   // its detuning is not to be trusted: no switch begins, no level of light is followed
    counts,  // the half is not valid
};

inline constexpr std::uint32_t no_bit = 0;

// clang-format off
template <class Row>
[[gnu::always_inline]] inline void for_each_monitor(const GyroControlConfig& c, const GyroControlState& s, const Observation& o, const Row& row) noexcept {
    row(health_frame_missed, Loses::nothing, !o.received);
    row(health_sequence_error, Loses::nothing, o.order.error);
    row(health_sign_error, Loses::counts, o.commuted.sign_error);
    row(health_timer_error, Loses::nothing, o.commuted.timer_error);
    row(health_echo_error, Loses::nothing, o.echo_error);
    row(no_bit, Loses::counts, o.commuted.latch_error || o.polarity_error);
    row(health_piezo_not_finite, Loses::nothing, o.order.fresh && !is_finite(o.piezo.value()));
    row(health_temperature_not_finite, Loses::nothing, o.order.fresh && !is_finite(o.temperature_c));
    row(health_light_lost, Loses::nothing, o.order.fresh && o.light.readable && !o.light.two_way);
    row(health_light_unusable, Loses::nothing, o.order.fresh && !o.light.readable);
    row(no_bit, Loses::counts, !o.lit || o.monitored.returns);
    row(health_light_stuck, Loses::light, o.monitored.stuck);
    row(no_bit, Loses::light, o.monitored.noisy);
    row(health_light_noisy, Loses::nothing, o.monitored.noisy || o.monitored.withheld);
    row(no_bit, Loses::light, o.monitored.unbalanced);
    row(health_light_unbalanced, Loses::nothing, s.light_balance.changes || (o.monitored.unbalanced && !is_learning(s.light_balance)));
    row(health_light_contradicted, Loses::light, o.monitored.contradicted);
    row(health_detuning_unsteady, Loses::counts, o.unsteady);
    row(health_detuning_over_limit, Loses::nothing, o.over_limit);
    row(health_counter_jump, Loses::counts, o.beyond);
    row(health_rate_over_range, Loses::nothing, o.beyond && s.was_beyond);
    row(health_counter_bit_stuck, Loses::counts, o.bit_stuck);
    row(health_bias_lost, Loses::counts, o.bias_wrong);
    row(health_helicity_reversed, Loses::nothing, o.lased && o.bias.reversed);
    row(health_rate_near_bias, Loses::nothing, o.lased && o.bias.near_rate);
    row(health_coil_current, Loses::nothing, o.coil.off);
    row(no_bit, Loses::counts, o.coil.unbalanced);
    row(health_fringe_lost, Loses::nothing, c.fringe.reads && o.order.fresh && o.lit && !(o.fringe.fringe >= 0.0f));
    row(health_fringe_skewed, Loses::nothing, o.fringe.skewed);
    row(health_switching, Loses::nothing, o.phase == SwitchPhase::open || o.phase == SwitchPhase::settling);
    row(health_relock_failed, Loses::nothing, o.phase == SwitchPhase::returning || o.phase == SwitchPhase::searching);
    row(health_searching, Loses::nothing, o.phase == SwitchPhase::searching);
    row(health_half_wave_rejected, Loses::nothing, o.half_wave_rejected);
    row(health_piezo_near_range_end, Loses::nothing, o.near_range_end);
    row(health_recentring, Loses::nothing, s.recentring);
    row(health_warming_up, Loses::nothing, o.warms_up);
    row(health_edges_shifted, Loses::nothing, c.commutator.dither.method != DitherMethod::none);
}
// clang-format on

// Whether something is seen for which a half loses this.
template <Loses what>
[[nodiscard]] bool loses(const GyroControlConfig& c, const GyroControlState& s, const Observation& o) noexcept {
    bool found = false;
    for_each_monitor(c, s, o, [&](std::uint32_t, Loses lost, bool seen) { found = found || (lost == what && seen); });
    return found;
}

[[nodiscard]] inline std::uint32_t health_word(const GyroControlConfig& c, const GyroControlState& s,
                                               const Observation& o) noexcept {
    std::uint32_t word = 0;
    for_each_monitor(c, s, o, [&](std::uint32_t bit, Loses, bool seen) { word |= seen ? bit : 0u; });
    return word;
}

}  // namespace zlg::core
