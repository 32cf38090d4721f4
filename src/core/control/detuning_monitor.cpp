#include <zlg/core/control/detuning_monitor.hpp>

#include "common/bounds.hpp"

namespace zlg::core {

bool step(const MonitorLimits& limits, DetuningMonitorState& state, bool is_second, bool is_good, bool is_settled,
          bool is_known, double mean_sq_lambda2) noexcept {
    if (!(limits.detuning_change_lambda2 > 0.0)) return false;
    bool unsteady = false;
    if (!is_second) {
        state.has_first = is_known;
        state.first_lambda2 = mean_sq_lambda2;
    } else if (state.has_first && is_known && is_good && is_settled) {
        const bool large = size(mean_sq_lambda2 - state.first_lambda2) > limits.detuning_change_lambda2;
        unsteady = large && state.n_good > 2 * limits.relock_ticks;
    }
    count_row(state.n_good, is_good && !unsteady);
    return unsteady;
}

}  // namespace zlg::core
