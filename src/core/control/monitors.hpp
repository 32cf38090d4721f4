#pragma once
// The table of monitors: what is watched in a half, the bit that says so, and what the half then loses.
//
// A new monitor is a row; where it needs a memory, its module fills in the observation. Limits and debounces stand in the modules.

#include <array>
#include <cstdint>
#include <utility>

#include <zlg/core/common/maths.hpp>
#include <zlg/core/health.hpp>

#include "gyro_observation.hpp"

namespace zlg::core {

enum class Loses : unsigned char {
    nothing,
    light,   // the detuning of the half is not to be trusted: no switch begins, no level of light is followed
    counts,  // the half is not valid
};

inline constexpr std::uint32_t no_bit = 0;

struct Monitor {
    std::uint32_t bit;
    Loses loses;
    bool (*sees)(const Observation& o);
};

using Seen = const Observation&;

// clang-format off
inline constexpr std::array monitors{
    Monitor{health_frame_missed, Loses::nothing, [](Seen o) { return !o.received; }},
    Monitor{health_sequence_error, Loses::nothing, [](Seen o) { return o.sequence_error; }},
    Monitor{health_sign_error, Loses::counts, [](Seen o) { return o.commuted.sign_error; }},
    Monitor{health_timer_error, Loses::nothing, [](Seen o) { return o.commuted.timer_error; }},
    Monitor{no_bit, Loses::counts, [](Seen o) { return o.commuted.latch_error; }},
    Monitor{health_echo_error, Loses::nothing, [](Seen o) { return o.echo_error; }},
    Monitor{no_bit, Loses::counts, [](Seen o) { return o.polarity_error; }},
    Monitor{health_piezo_not_finite, Loses::nothing, [](Seen o) { return o.fresh && !is_finite(o.piezo.value()); }},
    Monitor{health_temperature_not_finite, Loses::nothing, [](Seen o) { return o.fresh && !is_finite(o.temperature_c); }},
    Monitor{health_light_lost, Loses::nothing, [](Seen o) { return o.fresh && o.light.readable && !o.light.two_way; }},
    Monitor{health_light_unusable, Loses::nothing, [](Seen o) { return o.fresh && !o.light.readable; }},
    Monitor{no_bit, Loses::counts, [](Seen o) { return !o.lit || o.monitored.returns; }},
    Monitor{health_light_stuck, Loses::light, [](Seen o) { return o.monitored.stuck; }},
    Monitor{no_bit, Loses::light, [](Seen o) { return o.monitored.noisy; }},
    Monitor{health_light_noisy, Loses::nothing, [](Seen o) { return o.monitored.noisy || o.monitored.withheld; }},
    Monitor{health_light_unbalanced, Loses::light, [](Seen o) { return o.monitored.unbalanced; }},
    Monitor{health_light_contradicted, Loses::light, [](Seen o) { return o.monitored.contradicted; }},
    Monitor{health_detuning_unsteady, Loses::counts, [](Seen o) { return o.unsteady; }},
    Monitor{health_detuning_over_limit, Loses::nothing, [](Seen o) { return o.over_limit; }},
    Monitor{health_counter_jump, Loses::counts, [](Seen o) { return o.beyond; }},
    Monitor{health_rate_over_range, Loses::nothing, [](Seen o) { return o.beyond && o.was_beyond; }},
    Monitor{health_counter_bit_stuck, Loses::counts, [](Seen o) { return o.bit_stuck; }},
    Monitor{health_bias_lost, Loses::counts, [](Seen o) { return o.bias_wrong; }},
    Monitor{health_helicity_reversed, Loses::nothing, [](Seen o) { return o.lased && o.bias.reversed; }},
    Monitor{health_rate_near_bias, Loses::nothing, [](Seen o) { return o.lased && o.bias.near_rate; }},
    Monitor{health_coil_current, Loses::nothing, [](Seen o) { return o.coil.off; }},
    Monitor{no_bit, Loses::counts, [](Seen o) { return o.coil.unbalanced; }},
    Monitor{health_fringe_lost, Loses::nothing, [](Seen o) { return o.reads_fringe && o.fresh && o.lit && !(o.fringe.fringe >= 0.0f); }},
    Monitor{health_fringe_skewed, Loses::nothing, [](Seen o) { return o.fringe.skewed; }},
    Monitor{health_switching, Loses::nothing, [](Seen o) { return o.phase == SwitchPhase::open || o.phase == SwitchPhase::settling; }},
    Monitor{health_relock_failed, Loses::nothing, [](Seen o) { return o.phase == SwitchPhase::returning || o.phase == SwitchPhase::searching; }},
    Monitor{health_searching, Loses::nothing, [](Seen o) { return o.phase == SwitchPhase::searching; }},
    Monitor{health_half_wave_rejected, Loses::nothing, [](Seen o) { return o.half_wave_rejected; }},
    Monitor{health_piezo_near_range_end, Loses::nothing, [](Seen o) { return o.near_range_end; }},
    Monitor{health_recentring, Loses::nothing, [](Seen o) { return o.recentring; }},
    Monitor{health_warming_up, Loses::nothing, [](Seen o) { return o.warms_up; }},
    Monitor{health_edges_shifted, Loses::nothing, [](Seen o) { return o.shifts_edges; }},
};
// clang-format on

// Whether a row is seen for which a half loses this.
template <Loses what>
[[nodiscard]] bool loses(const Observation& o) noexcept {
    return [&]<std::size_t... k>(std::index_sequence<k...>) {
        return ((monitors[k].loses == what && monitors[k].sees(o)) || ...);
    }
    (std::make_index_sequence<monitors.size()>{});
}

[[nodiscard]] inline std::uint32_t health_word(const Observation& o) noexcept {
    return [&]<std::size_t... k>(std::index_sequence<k...>) {
        return ((monitors[k].bit != no_bit && monitors[k].sees(o) ? monitors[k].bit : 0u) | ...);
    }
    (std::make_index_sequence<monitors.size()>{});
}

}  // namespace zlg::core
