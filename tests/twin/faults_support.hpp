#pragma once
// A quiet twin with faults, half by half.

#include <zlg/twin/faults.hpp>
#include <zlg/twin/twin.hpp>

#include "quiet_gyro.hpp"

namespace zlg::twin {

inline constexpr double half_s = 0.0025;

// A quiet gyro whose light, counter and converters have nothing but the fault.
inline std::vector<TwinHalf> with_faults(TwinConfig config, std::vector<Fault> faults, int n_halves,
                                         const Motion& motion = Motion::rest()) {
    config.faults = std::move(faults);
    Twin twin{config, motion};
    return advance(twin, frame(true, 1), n_halves);
}

inline std::vector<TwinHalf> with_fault(FaultKind kind, double at_s, double duration_s, double size, int n_halves) {
    return with_faults(quiet_gyro(), {{kind, at_s, duration_s, size}}, n_halves);
}

inline std::int64_t counts(const std::vector<TwinHalf>& halves, std::size_t h) {
    return count_between(halves[h - 1], halves[h]);
}

inline double light_ratio(const core::SensorFrame& s, std::size_t k) {
    return double{s.light_a[k]} / double{s.light_b[k]};
}

}  // namespace zlg::twin
