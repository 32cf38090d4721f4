#include <zlg/core/control/counter_monitor.hpp>

#include "common/bounds.hpp"

namespace zlg::core {
namespace {

constexpr std::uint32_t judged_bits = 0x7ffffffe;

// Steps beyond are no rotation; their sums stay far from an overflow.
constexpr std::int64_t max_unevenness = std::int64_t{1} << 40;

void count_changes(CounterMonitorState& s, std::uint32_t bits) noexcept {
    s.changed |= bits;
    const std::uint32_t carry = s.changed_odd & bits;
    s.changed_odd ^= bits;
    s.changed_often |= s.changed_two & carry;
    s.changed_two ^= carry;
}

// Of ways: beyond the limit they are long enough for every bit.
std::int64_t limited_sum(std::int64_t a, std::int64_t b) noexcept {
    if (b > max_unevenness || a > max_unevenness) return max_unevenness;
    if (b < -max_unevenness || a < -max_unevenness) return -max_unevenness;
    return a + b;
}

// Second difference of the steps in halves of the same bias sign: the bias drops out, and a constant acceleration too.
std::int64_t unevenness(const CounterMonitorState& s, std::int64_t step) noexcept {
    const auto wrapped =
        static_cast<std::int64_t>(static_cast<std::uint64_t>(step) - 2 * static_cast<std::uint64_t>(s.steps[1]) +
                                  static_cast<std::uint64_t>(s.steps[3]));
    if (wrapped > max_unevenness || wrapped < -max_unevenness) return max_unevenness;
    return wrapped < 0 ? -wrapped : wrapped;
}

// Rounding alone makes a mean of one count and a half, shifted edges two. A stuck bit makes 1.5 of its own value.
std::uint32_t bits_below(std::int64_t unevenness) noexcept {
    constexpr std::int64_t min_mean_counts = 5;  // in halves: 2.5
    std::uint32_t bits = 0;
    for (int k = 1; k < 31; ++k) {
        const std::int64_t by_value = std::int64_t{counter_window_halves} << (k - 1);
        const std::int64_t least = counter_window_halves * min_mean_counts / 2;
        if (unevenness >= (by_value > least ? by_value : least)) bits |= std::uint32_t{1} << k;
    }
    return bits;
}

// A bit whose error is no longer seen for a second may be right again, or at rest: what it holds does no harm.
constexpr std::int32_t calm_windows = 12;

// Windows in a row in one direction before a bit is reported: an oscillation whose period is a few halves never has so
// many.
constexpr std::int32_t window_debounce = 6;

// Bits that looked stuck all the way, which was so long that they should have changed several times.
std::uint32_t still_all_the_way(CounterMonitorState& s, std::uint32_t still) noexcept {
    const auto net = static_cast<std::int64_t>(s.reading - s.window_reading);
    s.window_reading = s.reading;
    const bool same_way = (net > 0 && s.way > 0) || (net < 0 && s.way < 0);
    const bool goes_on = s.n_same_way > 0 && same_way && (s.still & still) != 0;
    s.still = goes_on ? s.still & still : still;
    s.n_same_way = goes_on ? s.n_same_way + (s.n_same_way < window_debounce) : 1;
    s.way = goes_on ? limited_sum(s.way, net) : net;
    if (s.n_same_way < window_debounce || s.still == 0) return 0;
    std::uint32_t passed = 0;
    const std::int64_t way = s.way < 0 ? -s.way : s.way;
    for (int k = 1; k < 31; ++k) {
        if (way >= std::int64_t{1} << (k + 3)) passed |= std::uint32_t{1} << k;
    }
    return s.still & passed;
}

void begin_window(CounterMonitorState& s) noexcept {
    s.changed = s.changed_odd = s.changed_two = s.changed_often = 0;
    s.unevenness = 0;
    s.n_halves = 0;
}

void end_window(CounterMonitorState& s) noexcept {
    std::uint32_t still = ~s.changed & (s.changed_often << 1) & (s.changed_often >> 1) & judged_bits;
    if (still != 0) still &= bits_below(s.unevenness);
    s.n_calm = s.unevenness < 2 * counter_window_halves ? s.n_calm + 1 : 0;
    s.stuck &= ~s.changed;
    if (s.n_calm >= calm_windows) {
        s.stuck = 0;
        s.n_calm = 0;
    }
    s.stuck |= still_all_the_way(s, still);
    begin_window(s);
}

}  // namespace

bool step(const CounterMonitorConfig& config, CounterMonitorState& state, bool counted,
          std::uint64_t reading) noexcept {
    if (!config.watches) return false;
    if (!counted) {
        state.n_known = 0;
        state.n_same_way = 0;
        state.window_reading = reading;
        begin_window(state);
    }
    const auto step = static_cast<std::int64_t>(reading - state.reading);
    if (state.n_known >= 2) count_changes(state, static_cast<std::uint32_t>(reading ^ state.reading_before));
    if (state.n_known >= 5) {
        state.unevenness += unevenness(state, step);
        if (state.unevenness > max_unevenness) state.unevenness = max_unevenness;
    }
    state.steps = {step, state.steps[0], state.steps[1], state.steps[2]};
    state.reading_before = state.reading;
    state.reading = reading;
    if (state.n_known < 6) ++state.n_known;
    if (++state.n_halves >= counter_window_halves) end_window(state);
    return state.stuck != 0;
}

}  // namespace zlg::core
