#pragma once
// When to switch: a grid of tick borders, laid once from the start of the run.

#include <cstdint>

namespace zlg::core {

enum class FirstSegment : unsigned char {
    full,
    half,  // interval/2, rounded down: the sequence A BB AA BB ... cancels the slow change of the magnetic drift
};

struct SwitchScheduleConfig {
    std::int64_t interval_ticks = 18000;  // opening to opening, 1..2^53
    FirstSegment first_segment = FirstSegment::full;
};

enum class SwitchScheduleFault : unsigned char { none, interval };

[[nodiscard]] constexpr SwitchScheduleFault check(const SwitchScheduleConfig& c) noexcept {
    if (!(c.interval_ticks >= 1 && c.interval_ticks <= (std::int64_t{1} << 53))) return SwitchScheduleFault::interval;
    return SwitchScheduleFault::none;
}

// The tick before which the loop opens for the first time.
[[nodiscard]] constexpr std::int64_t first_tick(const SwitchScheduleConfig& c) noexcept {
    return c.first_segment == FirstSegment::half ? c.interval_ticks / 2 : c.interval_ticks;
}

struct SwitchScheduleState {
    std::int64_t next_tick = 0;  // next point of the grid
    bool waiting = false;        // a point was passed when the gyro was not ready

    friend constexpr bool operator==(const SwitchScheduleState&, const SwitchScheduleState&) = default;
};

[[nodiscard]] constexpr SwitchScheduleState initial_state(const SwitchScheduleConfig& c) noexcept {
    return {.next_tick = first_tick(c)};
}

struct SwitchScheduleOutput {
    bool open = false;  // open the loop at the start of this tick
    bool late = false;  // the grid's point itself was missed
};

// Ask at every tick border whether to open.
//
//   opening k is due before tick first_tick + k interval_ticks, k = 0, 1, ...
//
// config  passed `check`.
// state   from `initial_state`.
// tick    that starts now, counted from the start of the run; one more at every call. Should it jump over a whole
//         interval, the grid is laid anew from there.
// ready   the gyro is tracking. A point that is due when it is not waits; several that wait are one. A late opening
//         does not move the grid.
[[nodiscard]] SwitchScheduleOutput step(const SwitchScheduleConfig& config, SwitchScheduleState& state,
                                        std::int64_t tick, bool ready) noexcept;

}  // namespace zlg::core
