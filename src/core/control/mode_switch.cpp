#include <zlg/core/control/mode_switch.hpp>

#include <zlg/core/common/maths.hpp>

#include "common/bounds.hpp"

namespace zlg::core {
namespace {

// Weight of a new half in the smoothed detuning: light noise shrinks four times, and a lock is seen four ticks later.
constexpr double smoothing_weight = 0.125;

constexpr std::int8_t inverse(std::int8_t sign) noexcept { return static_cast<std::int8_t>(-sign); }

void add(PiezoReadings& r, double voltage_v) noexcept {
    r.voltage_v[static_cast<std::size_t>(r.next)] = voltage_v;
    r.next = (r.next + 1) % most_readings;
    if (r.n < most_readings) ++r.n;
    r.age = 0;
}

double mean_v(const PiezoReadings& r) noexcept {
    double sum_v = 0.0;
    for (std::int32_t k = 0; k < r.n; ++k) sum_v += r.voltage_v[static_cast<std::size_t>(k)];
    return sum_v / r.n;
}

bool fresh(const PiezoReadings& r) noexcept { return r.n > 0 && r.age <= most_readings; }

void judge_lock(const ModeSwitchConfig& c, ModeSwitchState& s, const ModeSwitchInput& in) noexcept {
    const double detuning_lambda = in.detuning.value();
    s.detuning_lambda =
        s.smoothing ? s.detuning_lambda + smoothing_weight * (detuning_lambda - s.detuning_lambda) : detuning_lambda;
    s.smoothing = true;
    const bool is_near = size(s.detuning_lambda) <= c.lock_tolerance.value();
    count_row(s.n_locked, is_near);
    count_row(s.n_lost, !is_near);
    if (is_near && plausible(c.range, in.piezo)) add(s.readings, in.piezo.value());
}

// Evidence for or against the lock from one half with the loop closed.
void watch(const ModeSwitchConfig& c, ModeSwitchState& s, const ModeSwitchInput& in) noexcept {
    count_up(s.readings.age);
    if (!in.light_known) return;
    count_row(s.n_dark, !in.two_way);
    if (!in.two_way) {
        s.n_locked = 0;
        count_up(s.n_lost);
        return;
    }
    if (!in.usable || !is_finite(in.detuning.value())) return;
    judge_lock(c, s, in);
}

void open_loop(const ModeSwitchConfig& c, ModeSwitchState& s, SwitchPhase phase, std::int8_t polarity,
               double set_point_v, std::int64_t tick) noexcept {
    if (!s.switching) s.tick_opened = tick;
    s.switching = true;
    s.phase = phase;
    s.loop_closed = false;
    s.polarity = polarity;
    s.set_point_v = clamp(c.range, Volts{set_point_v}).value();
    s.n_halves = 0;
}

void close_loop(ModeSwitchState& s) noexcept {
    if (s.phase == SwitchPhase::open) s.phase = SwitchPhase::settling;
    s.loop_closed = true;
    s.n_halves = s.n_locked = s.n_lost = s.n_dark = 0;
    s.smoothing = false;
    s.readings = PiezoReadings{};
}

// Whether the light of the last open half is that of the new mode, near its centre.
bool has_arrived(const ModeSwitchConfig& c, const ModeSwitchState& s, const ModeSwitchInput& in) noexcept {
    if (c.gap_min_ticks == 0 || s.phase != SwitchPhase::open) return false;
    if (!in.tick_border || s.n_halves < 2 * c.gap_min_ticks) return false;
    if (!(in.light_known && in.two_way && in.usable && in.at_rest)) return false;
    return size((in.detuning + in.in_flight).value()) <= c.arrival_tolerance.value();
}

void remember_good(const ModeSwitchConfig& c, ModeSwitchState& s, const ModeSwitchInput& in) noexcept {
    s.good_measured = fresh(s.readings);
    s.good_v = s.readings.n > 0 ? mean_v(s.readings) : clamp(c.range, in.set_point).value();
    s.good_polarity = s.polarity;
}

void begin_switch(const ModeSwitchConfig& c, ModeSwitchState& s, const ModeSwitchInput& in) noexcept {
    remember_good(c, s, in);
    const int sign = choose_direction(c.range, Volts{s.good_v}, in.half_wave).sign;
    const double target_v = s.good_v + sign * in.half_wave.value() + in.offset.value();
    open_loop(c, s, SwitchPhase::open, inverse(s.polarity), target_v, in.next_tick);
    if (in.recentre) s.good_measured = false;
}

// Go on where the gyro is, with the helicity that it has.
void adopt(ModeSwitchState& s) noexcept {
    if (s.phase != SwitchPhase::searching) s.phase = SwitchPhase::returning;
    close_loop(s);
    s.polarity = s.good_polarity = inverse(s.polarity);
    s.good_measured = false;
}

void begin_return(const ModeSwitchConfig& c, ModeSwitchState& s, const ModeSwitchInput& in) noexcept {
    open_loop(c, s, SwitchPhase::returning, s.good_polarity, s.good_v, in.next_tick);
}

// Each place of the range twice, first with the helicity that was held last.
void try_place(const ModeSwitchConfig& c, ModeSwitchState& s, const ModeSwitchInput& in) noexcept {
    constexpr double max_places = 1000.0;  // bounds the search where the half-wave voltage is far too small
    const double span_v = c.range.max.value() - c.range.min.value();
    const double wanted = limited(2.0 * span_v / in.half_wave.value(), max_places);
    const std::int32_t n_places = wanted >= 1.0 ? static_cast<std::int32_t>(wanted) : 1;
    s.place = s.phase == SwitchPhase::returning ? 0 : s.place % (2 * n_places);
    const double fraction = (s.place / 2 + 0.5) / n_places;
    const std::int8_t polarity = s.place % 2 == 0 ? s.good_polarity : inverse(s.good_polarity);
    open_loop(c, s, SwitchPhase::searching, polarity, c.range.min.value() + fraction * span_v, in.next_tick);
    ++s.place;
}

SwitchOutcome outcome_of(SwitchPhase phase) noexcept {
    if (phase == SwitchPhase::returning) return SwitchOutcome::returned;
    return phase == SwitchPhase::searching ? SwitchOutcome::found : SwitchOutcome::switched;
}

SwitchEvent completed(const ModeSwitchState& s) noexcept {
    SwitchEvent e{.tick_opened = s.tick_opened, .outcome = outcome_of(s.phase)};
    e.has_half_wave = e.outcome == SwitchOutcome::switched && s.good_measured && fresh(s.readings);
    if (e.has_half_wave) e.half_wave_v = size(mean_v(s.readings) - s.good_v);
    return e;
}

std::optional<SwitchEvent> settle(const ModeSwitchConfig& c, ModeSwitchState& s, const ModeSwitchInput& in) noexcept {
    if (s.n_locked >= 2 * c.settle_ticks) {
        std::optional<SwitchEvent> event;
        if (s.switching) event = completed(s);
        s.switching = false;
        s.phase = SwitchPhase::tracking;
        return event;
    }
    const bool failed = s.n_halves >= 2 * c.lock_timeout_ticks || s.n_dark >= 2 * c.dark_ticks;
    if (!failed || !in.tick_border) return {};
    s.phase == SwitchPhase::settling ? begin_return(c, s, in) : try_place(c, s, in);
    return {};
}

void track(const ModeSwitchConfig& c, ModeSwitchState& s, const ModeSwitchInput& in) noexcept {
    if (in.tick_border && (in.due || in.recentre)) {
        begin_switch(c, s, in);
    } else if (in.tick_border && s.n_lost >= 2 * c.lock_timeout_ticks) {
        remember_good(c, s, in);
        begin_return(c, s, in);
    }
}

}  // namespace

SwitchDirection choose_direction(const PiezoRange& range, Volts now, Volts half_wave) noexcept {
    const Volts room_up = range.max - (now + half_wave);
    const Volts room_down = now - half_wave - range.min;
    // With more room up than down the upper neighbour is also the one nearer to the middle.
    const bool up = room_up >= room_down;
    return {.sign = static_cast<std::int8_t>(up ? 1 : -1),
            .out_of_range = !((up ? room_up : room_down) >= range.margin)};
}

ModeSwitchState initial_state(const ModeSwitchConfig& config) noexcept {
    const double start_v = config.start_set_point.value();
    return {.polarity = config.start_polarity,
            .set_point_v = start_v,
            .good_v = start_v,
            .good_polarity = config.start_polarity};
}

std::optional<SwitchEvent> step(const ModeSwitchConfig& config, ModeSwitchState& state,
                                const ModeSwitchInput& input) noexcept {
    count_up(state.n_halves);
    if (!state.loop_closed) {
        if (state.n_halves >= 2 * config.gap_ticks || has_arrived(config, state, input)) close_loop(state);
        return {};
    }
    watch(config, state, input);
    if (input.reversed && input.tick_border) {
        adopt(state);
    } else if (state.phase == SwitchPhase::tracking) {
        track(config, state, input);
    } else {
        return settle(config, state, input);
    }
    return {};
}

}  // namespace zlg::core
