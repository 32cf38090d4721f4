#pragma once
// The moment at which the loop begins to act: each that is tried gives a course of the first tick.
//
// Until the moment the detuning is what it is there. From it on it is one cubic to the end of the tick; where the moment
// lies in the second quarter, or the loop acts at once, it may be another one in each half. These are the fewest terms that
// leave slow, fast, dead and oscillating loops without bias (docs/compensation.md).

#include <cstdint>

#include "relock_chain.hpp"

namespace zlg::core {

inline constexpr std::int32_t relock_moments = 33;  // 0..T in steps of T/32

// Try the next moment: index = 0 .. relock_moments - 1, in this order.
void try_moment(RelockProfileState& state, std::int32_t index) noexcept;

// The mean of all moments: the profile of the first tick, and the link after it.
void average_moments(RelockProfileState& state) noexcept;

}  // namespace zlg::core
