#include <zlg/core/control/switch_schedule.hpp>

#include <algorithm>

#include <zlg/core/common/maths.hpp>

#include "common/bounds.hpp"

namespace zlg::core {
namespace {

// Ticks beyond are no time of a gyro; below, adding an interval cannot overflow.
constexpr std::int64_t tick_limit = std::int64_t{1} << 62;
constexpr std::int64_t max_interval_ticks = std::int64_t{1} << 53;

bool is_positive(double x) noexcept { return x > 0.0 && x <= 1e12; }

std::int64_t in_mode(std::int8_t mode, std::int64_t ticks) noexcept { return mode < 0 ? -ticks : ticks; }

void count_mode(const SwitchScheduleConfig& c, SwitchScheduleState& s, std::int8_t mode) noexcept {
    // The first segment, of the first interval, ends half an interval from the centre.
    const bool begins = s.imbalance_ticks == 0 && s.opened_tick == 0;
    if (begins && c.kind != ScheduleKind::fixed && c.first_segment == FirstSegment::full)
        s.centre_ticks = in_mode(mode, s.interval_ticks - s.interval_ticks / 2);
    s.imbalance_ticks = limited(s.imbalance_ticks + in_mode(mode, 1), max_interval_ticks);
}

bool is_due_on_grid(const SwitchScheduleConfig& c, SwitchScheduleState& s, std::int64_t tick) noexcept {
    if (tick < s.next_tick) return false;
    s.next_tick += c.interval_ticks;
    return true;
}

bool is_due_by_balance(const SwitchScheduleConfig& c, const SwitchScheduleState& s,
                       const SwitchScheduleInput& in) noexcept {
    const bool rested = s.opened_tick == 0 || in.tick - s.opened_tick >= c.min_ticks - c.min_ticks / 16;
    return rested && in_mode(in.mode, s.imbalance_ticks - s.centre_ticks) >= s.interval_ticks / 2;
}

bool is_due_by_end(const SwitchScheduleConfig& c, const SwitchScheduleState& s,
                   const SwitchScheduleInput& in) noexcept {
    const std::int64_t lead_ticks = in_mode(in.mode, s.imbalance_ticks);
    return c.end_tick > 0 && lead_ticks > 0 && lead_ticks >= c.end_tick - in.tick;
}

// Nothing is due after the opening that balances the end.
bool is_newly_due(const SwitchScheduleConfig& c, SwitchScheduleState& s, const SwitchScheduleInput& in) noexcept {
    if (!(in.tick >= 0 && in.tick < tick_limit)) return false;
    const bool regular = c.kind == ScheduleKind::fixed ? is_due_on_grid(c, s, in.tick) : is_due_by_balance(c, s, in);
    if (s.balanced) return false;
    s.balanced = is_due_by_end(c, s, in);
    return regular || s.balanced;
}

// Sixteen bits that look random: the last step of MurmurHash3 (A. Appleby, public domain).
std::uint32_t scattered(std::uint32_t x) noexcept {
    x = (x ^ (x >> 16U)) * 0x85ebca6bU;
    x = (x ^ (x >> 13U)) * 0xc2b2ae35U;
    return x >> 16U;
}

// Openings for which the larger part of what is left out stays the same.
constexpr std::uint32_t run_of_openings = 4;

// Up to a sixteenth shorter, at random, the same in every run. A quarter of it is drawn for each opening: equal
// intervals could hold a whole number of periods of a vibration, and every switch would then meet it at the same phase
// and leave the same error. Three quarters are drawn for four openings at a time, so that the switches wander soon from
// any regular grid, and no rotation of a steady period stays in step with them.
std::int64_t varied(std::int64_t interval_ticks, std::uint32_t n_openings) noexcept {
    const std::uint32_t part = (3 * scattered(n_openings / run_of_openings) + scattered(~n_openings)) / 4;  // of 65536
    const std::int64_t sixteenth = interval_ticks / 16;
    return interval_ticks - sixteenth / 65536 * part - sixteenth % 65536 * part / 65536;
}

// What a few switches have measured may be far off: the interval follows it step by step.
std::int64_t within_factor_2(std::int64_t before_ticks, std::int64_t wanted_ticks) noexcept {
    return std::clamp(wanted_ticks, before_ticks - before_ticks / 2, 2 * before_ticks);
}

void note_opening(const SwitchScheduleConfig& c, SwitchScheduleState& s, const SwitchScheduleInput& in) noexcept {
    s.opened_tick = in.tick;
    if (c.kind == ScheduleKind::fixed) return;
    s.interval_ticks =
        within_factor_2(s.interval_ticks, varied(balanced_interval(c, in.advice, in.tick), ++s.n_openings));
    s.imbalance_ticks = s.centre_ticks + limited(s.imbalance_ticks - s.centre_ticks, c.max_ticks);
}

}  // namespace

std::int64_t balanced_interval(const SwitchScheduleConfig& c, const SwitchAdvice& advice, std::int64_t tick) noexcept {
    const double error =
        is_positive(advice.switch_error_arcsec) ? advice.switch_error_arcsec : c.presumed.switch_error_arcsec;
    const double drift =
        is_positive(advice.magnetic_arcsec_s) ? advice.magnetic_arcsec_s : c.presumed.magnetic_arcsec_s;
    const double time_s = static_cast<double>(tick > 1 ? tick : 1) * c.tick_s;
    const double ratio = error / drift;
    const double ticks = maths::exp(maths::log(6.0 * ratio * ratio * time_s) / 3.0) / c.tick_s;
    if (!(ticks > static_cast<double>(c.min_ticks))) return c.min_ticks;
    return ticks < static_cast<double>(c.max_ticks) ? static_cast<std::int64_t>(ticks) : c.max_ticks;
}

std::int64_t first_tick(const SwitchScheduleConfig& c) noexcept {
    const std::int64_t interval = c.kind == ScheduleKind::fixed ? c.interval_ticks : balanced_interval(c, {}, 1);
    return c.first_segment == FirstSegment::half ? interval / 2 : interval;
}

SwitchScheduleState initial_state(const SwitchScheduleConfig& c) noexcept {
    return {.next_tick = first_tick(c),
            .interval_ticks = c.kind == ScheduleKind::fixed ? c.interval_ticks : balanced_interval(c, {}, 1)};
}

bool step(const SwitchScheduleConfig& config, SwitchScheduleState& state, const SwitchScheduleInput& in) noexcept {
    count_mode(config, state, in.mode);
    const bool planned = (is_newly_due(config, state, in) || state.waiting) && !state.held;
    state.waiting = planned && !in.ready;
    if (!((planned || state.asked) && in.ready)) return false;
    state.asked = false;
    note_opening(config, state, in);
    return true;
}

}  // namespace zlg::core
