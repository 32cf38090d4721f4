#pragma once
// The final values of a gap and of the re-lock ticks after it, by the learnt motion alone or by the mixture (gap_mixture.hpp).

#include <zlg/core/compensation/gap_bridge_state.hpp>

#include "gap_estimate.hpp"

namespace zlg::core {

// The mixture has found something. Where it has not, the estimate stays what it was, to the last bit.
[[nodiscard]] bool finds_something(const GapMixture& mixture) noexcept;

// The mean square error of the mixture's angle, `variance` that of the learnt motion alone. Each model errs about its own
// estimate, which lies off the mean.
[[nodiscard]] double mixed_variance(const GapBridgeState& state, double variance) noexcept;

// By the learnt motion alone.
//
// variance  of the whole angle.
void apply(GapBridgeState& state, const Gap& gap, const GapEstimate& found, double variance,
           EstimatedAngle& out) noexcept;

// By the mixture. The correlation between its ticks is not known; their sigma is set as if they were independent.
//
// of_learnt  variance of the whole angle by the learnt motion alone.
// variance   of the whole angle.
void apply_mixture(GapBridgeState& state, const Gap& gap, double of_learnt, double variance,
                   EstimatedAngle& out) noexcept;

}  // namespace zlg::core
