#include <zlg/core/switch_schedule.hpp>

namespace zlg::core {
namespace {

// Ticks beyond are no time of a gyro; below, adding an interval cannot overflow.
constexpr std::int64_t most_ticks = std::int64_t{1} << 62;

}  // namespace

SwitchScheduleOutput step(const SwitchScheduleConfig& config, SwitchScheduleState& state, std::int64_t tick,
                          bool ready) noexcept {
    const bool on_grid = tick == state.next_tick;
    const bool newly_due = tick >= state.next_tick && tick < most_ticks;
    if (newly_due) {
        state.next_tick += config.interval_ticks;
        if (state.next_tick <= tick) state.next_tick = tick + config.interval_ticks;
    }
    const bool due = newly_due || state.waiting;
    state.waiting = due && !ready;
    return {.open = due && ready, .late = due && ready && !on_grid};
}

}  // namespace zlg::core
