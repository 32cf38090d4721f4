#pragma once
// When to switch: on a grid of tick borders, or as the magnetic drift and the errors of the switches call for.

#include <cstdint>

#include <zlg/core/records.hpp>

namespace zlg::core {

enum class FirstSegment : unsigned char {
    full,
    half,  // interval/2, rounded down: the sequence A BB AA BB ... cancels the slow change of the magnetic drift
};

enum class ScheduleKind : unsigned char {
    fixed,     // a grid, laid once from the start of the run
    measured,  // by the time that has passed, and the errors and the drift that compensation has measured
};

struct SwitchScheduleConfig {
    std::int64_t interval_ticks = 18000;  // of the grid, opening to opening, 1..2^53
    FirstSegment first_segment = FirstSegment::full;
    ScheduleKind kind = ScheduleKind::fixed;
    std::int64_t min_ticks = 2000;    // of an interval that is not fixed, 1..2^53
    std::int64_t max_ticks = 120000;  // no less than that, up to 2^53
    double tick_s = 0.005;            // of these intervals, > 0
    SwitchAdvice presumed{.switch_error_arcsec = 2.0, .magnetic_arcsec_s = 0.7};  // > 0
    std::int64_t end_tick = 0;  // the end of the run, if the last segment is to end it in balance; 0: not known
};

[[nodiscard]] constexpr bool is_allowed(const SwitchScheduleConfig& c) noexcept {
    constexpr std::int64_t most = std::int64_t{1} << 53;
    const auto is_positive = [](double x) { return x > 0.0 && x <= 1e12; };
    return c.interval_ticks >= 1 && c.interval_ticks <= most && c.min_ticks >= 1 && c.min_ticks <= c.max_ticks &&
           c.max_ticks <= most && is_positive(c.tick_s) && is_positive(c.presumed.switch_error_arcsec) &&
           is_positive(c.presumed.magnetic_arcsec_s) && c.end_tick >= 0 && c.end_tick <= most;
}

// The interval that balances the errors of the switches against the sawtooth that stands between them, ticks.
//
//   variance of the angle at time t   s^2 t/L + c Om^2 L^2,   L = (s^2 t/(2 c Om^2))^(1/3)
//
// s the independent error of a switch, Om the drift, c = 1/12 for a sawtooth about its mean. What is not known by the
// advice is taken as presumed; L is kept between min_ticks and max_ticks.
[[nodiscard]] std::int64_t balanced_interval(const SwitchScheduleConfig& config, const SwitchAdvice& advice,
                                             std::int64_t tick) noexcept;

// The tick before which the loop opens for the first time, if nothing is in the way.
[[nodiscard]] std::int64_t first_tick(const SwitchScheduleConfig& config) noexcept;

struct SwitchScheduleState {
    std::int64_t next_tick = 0;        // next point of the grid
    bool waiting = false;              // a point was passed when the gyro was not ready
    std::int64_t opened_tick = 0;      // of the last opening
    std::int64_t interval_ticks = 0;   // in force, where it is not fixed
    std::uint32_t n_openings = 0;      // wraps
    std::int64_t imbalance_ticks = 0;  // ticks in mode + less those in mode -
    std::int64_t centre_ticks = 0;     // of its sawtooth, where the interval is not fixed
    bool balanced = false;             // the last opening before the end was made
    bool held = false;                 // set from outside: nothing is due by the schedule
    bool asked = false;                // set from outside: one opening is due, held or not; cleared when it is made

    friend constexpr bool operator==(const SwitchScheduleState&, const SwitchScheduleState&) = default;
};

[[nodiscard]] SwitchScheduleState initial_state(const SwitchScheduleConfig& config) noexcept;

struct SwitchScheduleInput {
    std::int64_t tick = 0;  // that starts now, counted from the start of the run; one more at every call
    bool ready = true;      // the gyro is tracking: what is due when it is not waits, several that wait are one
    std::int8_t mode = 1;   // of the tick that ends now
    SwitchAdvice advice{};  // for `measured`
};

// Ask at every tick border whether to open the loop at the start of this tick.
//
//   fixed     opening k is due before tick first_tick + k interval_ticks, k = 0, 1, ...; a late one does not move the
//             grid.
//   measured  due where the time in mode + exceeds that in mode - by interval/2, or the other way round: so the
//   sawtooth
//             stays centred while the interval changes, and a late opening is made good by the next one. With a full
//             first segment its centre is half of the first interval. Up to 1/16 of the interval is left out, a
//             different part each time, so that no vibration keeps step. 15/16 of min_ticks pass between two openings
//             at least; what exceeds max_ticks is forgotten. From one opening to the next the interval changes by a
//             factor of 2 at most.
//   end_tick  the last opening is due where the time that is left just makes up for the imbalance.
//   held      points of the grid pass; when it ends, `measured` is due at once where the time in the modes asks for it.
//
// config  passed `check`.
// state   from `initial_state`.
// cost    a cube root at every opening, else a few comparisons.
[[nodiscard]] bool step(const SwitchScheduleConfig& config, SwitchScheduleState& state,
                        const SwitchScheduleInput& input) noexcept;

}  // namespace zlg::core
