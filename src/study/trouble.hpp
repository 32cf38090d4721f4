#pragma once
// Which bits of the health are trouble, and not a sound gyro at work.

#include <cstdint>

#include <zlg/core/health.hpp>

namespace zlg::study {

// Of the health of one half. A switch darkens the beams and finds the perimeter far off, in every gyro.
[[nodiscard]] constexpr std::uint32_t trouble_bits(std::uint32_t health) {
    using namespace core;
    constexpr std::uint32_t at_work = health_switching | health_recentring | health_warming_up | health_edges_shifted;
    constexpr std::uint32_t of_a_switch = health_light_lost | health_detuning_over_limit;
    const bool is_switching = (health & health_switching) != 0;
    return health & ~at_work & ~(is_switching ? of_a_switch : 0u);
}

}  // namespace zlg::study
