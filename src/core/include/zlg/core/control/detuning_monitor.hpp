#pragma once
// Steadiness of the detuning while no re-lock is due: a perimeter that is pushed changes the bias within a tick, and
// the false angle that it leaves in the tick is corrected only after a gap.

#include <cstdint>

namespace zlg::core {

struct DetuningMonitorConfig {
    double max_change_lambda2 = 0.0;  // of the mean square within a tick, 0..1e6; 0: nothing is judged
    std::int32_t relock_ticks = 20;   // after a gap, whose false angle the compensation subtracts, 0..2^24
};

enum class DetuningMonitorFault : unsigned char { none, max_change, relock_ticks };

[[nodiscard]] constexpr DetuningMonitorFault check(const DetuningMonitorConfig& c) noexcept {
    if (!(c.max_change_lambda2 >= 0.0 && c.max_change_lambda2 <= 1e6)) return DetuningMonitorFault::max_change;
    if (!(c.relock_ticks >= 0 && c.relock_ticks <= (1 << 24))) return DetuningMonitorFault::relock_ticks;
    return DetuningMonitorFault::none;
}

struct DetuningMonitorState {
    bool has_first = false;  // the first half of the tick had a mean square
    double first_lambda2 = 0.0;
    std::int32_t n_good = 0;  // halves in a row that were closed and valid

    friend constexpr bool operator==(const DetuningMonitorState&, const DetuningMonitorState&) = default;
};

struct DetuningMonitorInput {
    bool is_second = false;   // half of its tick
    bool is_good = false;     // closed, and valid by all that is known
    bool is_settled = false;  // the lock was seen
    bool is_known = false;    // the mean square was measured
    double mean_sq_lambda2 = 0.0;
};

// Advance by one half-period; returns whether its tick holds a false angle that no correction subtracts.
//
//   |dl^2_second - dl^2_first| > max_change, in a tick that is settled and further from a gap than relock_ticks
//
// The tick becomes a gap by this, so the ones after it are corrected: a push costs one tick.
[[nodiscard]] bool step(const DetuningMonitorConfig& config, DetuningMonitorState& state,
                        const DetuningMonitorInput& input) noexcept;

}  // namespace zlg::core
