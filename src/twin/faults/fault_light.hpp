#pragma once
// Faults of the light itself: both photodiodes and the beat see them.

#include <span>

#include <zlg/twin/faults.hpp>

namespace zlg::twin {

// Of each beam at the centre; any unit, only ratios of light mean anything.
inline constexpr double light_level = 1000.0;

// What is left of each beam.
struct LightParts {
    double a = 1.0;
    double b = 1.0;

    // A wave below a hundredth of its intensity makes no beat that a counter could follow.
    [[nodiscard]] bool is_dark() const { return !(a > 0.01 && b > 0.01); }
};

[[nodiscard]] LightParts light_parts(std::span<const Fault> active, double time_s);

}  // namespace zlg::twin
