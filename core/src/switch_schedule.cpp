#include <zlg/core/switch_schedule.hpp>

namespace zlg::core {

SwitchScheduleOutput step(const SwitchScheduleConfig& config, SwitchScheduleState& state, std::int64_t tick,
                          bool ready) noexcept {
    const std::int64_t first = first_tick(config);
    const std::int64_t n_passed = tick < first ? 0 : (tick - first) / config.interval_ticks + 1;
    const bool on_grid = n_passed > 0 && (tick - first) % config.interval_ticks == 0;

    const bool newly_due = n_passed > state.n_passed;
    if (newly_due) state.n_passed = n_passed;
    const bool due = newly_due || state.waiting;

    state.waiting = due && !ready;
    return {.open = due && ready, .late = due && ready && !on_grid};
}

}  // namespace zlg::core
