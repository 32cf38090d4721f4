#pragma once
// The re-lock correction, with the constants that it is given.

#include <zlg/core/compensation/relock_drift.hpp>

namespace relock_drift_support {

struct Configured {
    zlg::core::CompensationConstants gyro{};
    zlg::core::RelockDriftConfig relock{};
};

inline Configured configured(zlg::core::RelockMethod method, std::int64_t ticks = 20) {
    return {.relock = {.method = method, .ticks = ticks}};
}

inline zlg::core::RelockDriftOutput step(const Configured& c, zlg::core::RelockDriftState& state,
                                         const zlg::core::RelockTick& tick) {
    return step(c.gyro, c.relock, state, tick);
}

}  // namespace relock_drift_support
