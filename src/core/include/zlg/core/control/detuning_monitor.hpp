#pragma once
// Steadiness of the detuning while no re-lock is due: a perimeter that is pushed changes the bias within a tick, and
// the false angle that it leaves in the tick is corrected only after a gap.

#include <cstdint>

#include <zlg/core/control/monitor_limits.hpp>

namespace zlg::core {

struct DetuningMonitorState {
    bool has_first = false;  // the first half of the tick had a mean square
    double first_lambda2 = 0.0;
    std::int32_t n_good = 0;  // halves in a row that were closed and valid

    friend constexpr bool operator==(const DetuningMonitorState&, const DetuningMonitorState&) = default;
};

// Advance by one half-period; returns whether its tick holds a false angle that no correction subtracts.
//
//   |dl^2_second - dl^2_first| > max_change, in a tick that is settled and further from a gap than relock_ticks
//
// The tick becomes a gap by this, so the ones after it are corrected: a push costs one tick.
//
// is_second   half of its tick.
// is_good     closed, and valid by all that is known.
// is_settled  the lock was seen.
// is_known    the mean square was measured.
[[nodiscard]] bool step(const MonitorLimits& limits, DetuningMonitorState& state, bool is_second, bool is_good,
                        bool is_settled, bool is_known, double mean_sq_lambda2) noexcept;

}  // namespace zlg::core
