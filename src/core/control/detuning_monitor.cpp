#include <zlg/core/control/detuning_monitor.hpp>

#include "common/bounds.hpp"

namespace zlg::core {

bool step(const DetuningMonitorConfig& config, DetuningMonitorState& state,
          const DetuningMonitorInput& input) noexcept {
    if (!(config.max_change_lambda2 > 0.0)) return false;
    bool unsteady = false;
    if (!input.is_second) {
        state.has_first = input.is_known;
        state.first_lambda2 = input.mean_sq_lambda2;
    } else if (state.has_first && input.is_known && input.is_good && input.is_settled) {
        const double change_lambda2 = input.mean_sq_lambda2 - state.first_lambda2;
        const bool large = change_lambda2 > config.max_change_lambda2 || change_lambda2 < -config.max_change_lambda2;
        unsteady = large && state.n_good > 2 * config.relock_ticks;
    }
    if (input.is_good && !unsteady) {
        count_up(state.n_good);
    } else {
        state.n_good = 0;
    }
    return unsteady;
}

}  // namespace zlg::core
