#include <zlg/core/compensation/gap_bridge_state.hpp>

namespace zlg::core {

bool is_profile_of(const GapBridgeState& state, const Gap& gap) noexcept {
    return state.joint.first_tick == gap.first_tick + gap.n;
}

bool needs_profile(const GapBridgeState& state) noexcept {
    for (int k = 0; k < state.n_pending; ++k) {
        const PendingGap& pending = state.pending[static_cast<unsigned>(k)];
        if (!pending.resolved && is_profile_of(state, pending.gap)) return true;
    }
    return false;
}

}  // namespace zlg::core
