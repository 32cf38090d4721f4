#pragma once
// Faults of a gyro: what breaks, when, for how long and how badly.
//
// Plain data. What a fault does is a function of time alone, so that a run with the same faults is the same run. The
// physical ones change light, perimeter, bias or motion and reach the processor only through what it measures; those of
// converters, counter and frames change what is latched or delivered.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <zlg/twin/fault_kinds.hpp>

namespace zlg::twin {

struct Fault {
    FaultKind kind = FaultKind::laser_off;
    double at_s = 0.0;
    double duration_s = 0.0;
    double size = 0.0;  // in the unit of its kind; nothing to those that have none
};

// The twin refuses more: each takes its part of every half in which it acts.
inline constexpr std::size_t max_faults_at_once = 100;

// Fault `number` of a seed, of this kind, with duration and size as its address draws them.
[[nodiscard]] Fault random_fault(FaultKind kind, double at_s, std::uint64_t seed, std::uint64_t number = 0);

// Faults at random moments from 0 to `until_s`, `per_hour` of them an hour on average, in the order of their start; the
// kinds equally often, all of them where `kinds` is empty.
//
// errors  std::invalid_argument for a rate or an end that is negative or not finite, or a million faults or more.
[[nodiscard]] std::vector<Fault> random_faults(double per_hour, double until_s, std::uint64_t seed,
                                               std::span<const FaultKind> kinds);

}  // namespace zlg::twin
