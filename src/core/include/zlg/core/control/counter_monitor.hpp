#pragma once
// The fringe counter, bit by bit: whether one of them is stuck.
//
// A stuck bit k shows as a bit that never changes while the ones beside it do, in a counter whose steps are not smooth:
// it is wrong by 2^k in some halves and right in others. A counter that stands still, or that moves evenly by a
// multiple of a power of two, has bits that do not change either, but its steps are smooth. One that swings and comes
// back to the same few readings has them too: so only a counter that goes one way is judged, which must pass through
// both values of a bit.

#include <array>
#include <cstdint>

namespace zlg::core {

struct CounterMonitorConfig {
    bool watches = false;
};

// Halves that are judged together.
inline constexpr std::int32_t counter_window_halves = 32;

struct CounterMonitorState {
    std::int32_t n_known = 0;   // readings in a row, one a half, up to 6
    std::uint64_t reading = 0;  // the last one, and the one before
    std::uint64_t reading_before = 0;
    std::array<std::int64_t, 4> steps{};  // from reading to reading, the last one first
    std::uint32_t changed = 0;            // in the window: bits that changed between readings of the same bias sign
    std::uint32_t changed_odd = 0;        // how often, modulo 4: two binary digits for each bit
    std::uint32_t changed_two = 0;
    std::uint32_t changed_often = 0;   // four times at least
    std::int64_t unevenness = 0;       // sum of the sizes of the second differences of those steps
    std::uint64_t window_reading = 0;  // at the end of the window before
    std::int64_t way = 0;              // counts since the windows in a row began that all went the same way
    std::int32_t n_same_way = 0;       // and how many there were
    std::uint32_t still = 0;           // bits that looked stuck in all of them
    std::int32_t n_halves = 0;         // in the window
    std::int32_t n_calm = 0;           // windows in a row without unevenness
    std::uint32_t stuck = 0;           // bits found stuck, which have not changed since

    friend constexpr bool operator==(const CounterMonitorState&, const CounterMonitorState&) = default;
};

// Advance by one half-period; returns whether a bit is stuck: no later counts are to be trusted.
//
// counted  the reading is that of this half, the one before was that of the half before, and the gyro lased in both.
// latency  eight windows, where the counter moves by more than 2^(k + 2) counts within one, always the same way. A bit that
//          changes again is accepted at the end of the window, and any bit after twelve windows without an uneven step.
// errors   bit 0 is not judged (a count more or less is within every sigma), nor are those from 31 on, whose errors are
//          beyond any rate. At rest and in a swing a stuck bit does not show.
[[nodiscard]] bool step(const CounterMonitorConfig& config, CounterMonitorState& state, bool counted,
                        std::uint64_t reading) noexcept;

}  // namespace zlg::core
