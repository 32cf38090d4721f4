#pragma once
// The sequencer of mode switching: from the mode of one helicity to its neighbour of the other, and the ways out when
// that fails.
//
// `open` .. `searching` are attempts to hold a mode: the loop is open for gap_ticks at a chosen voltage and helicity,
// then it is closed until it is locked or has failed. A switch closes it earlier, from gap_min_ticks on, at a tick
// border at which it has arrived: piezo at rest, usable light in the last half, and a detuning, with the rest of the
// move added, within arrival_tolerance. Locked: settle_ticks in a row within the tolerance, with light in both
// directions. Failed: no lock by lock_timeout_ticks, or dark for dark_ticks. A half of which nothing is known (frame
// missed, samples not finite) neither helps nor hurts a lock; time goes on.
//
//   state      | due           | gap over            | locked                   | failed (seen on a tick border)
//   -----------+---------------+---------------------+--------------------------+-------------------------------
//   tracking   | -> open       | -                   | stays                    | lost for lock_timeout: -> returning
//   open       | ignored       | closes -> settling  | -                        | -
//   settling   | ignored       | -                   | -> tracking, `switched`  | -> returning
//   returning  | ignored       | closes, stays       | -> tracking, `returned`  | -> searching, first place
//   searching  | ignored       | closes, stays       | -> tracking, `found`     | stays, next place
//
// A mode of the other helicity than was commanded is kept, and the command follows it: its place is as good, and a
// reference of the wrong sign would drive it away. What remains is a lock to be seen, as after a return.
//
// The gyro starts in `settling`, loop closed; the lock that ends the start is no event. Searching goes through the
// range in steps of half a half-wave voltage, each with both helicities, round and round until a mode is held.

#include <array>
#include <cstdint>
#include <optional>

#include <zlg/core/control/piezo_range.hpp>
#include <zlg/core/units.hpp>

namespace zlg::core {

enum class SwitchPhase : unsigned char { tracking, open, settling, returning, searching };
enum class SwitchOutcome : unsigned char { switched, returned, found };

struct ModeSwitchConfig {
    PiezoRange range{};
    std::int32_t gap_ticks = 3;      // 1..2^24, like all numbers of ticks here
    std::int32_t gap_min_ticks = 0;  // up to gap_ticks; 0: the gap is not shortened
    std::int32_t settle_ticks = 20;
    std::int32_t lock_timeout_ticks = 60;  // from closing; > settle_ticks, by five time constants of the loop or more
    std::int32_t dark_ticks = 2;
    Wavelengths lock_tolerance{0.02};     // of the detuning, smoothed over about eight halves
    Wavelengths arrival_tolerance{0.05};  // of the detuning to which the voltage leads: a switch has arrived
    Volts start_set_point{150.0};         // inside the range
    std::int8_t start_polarity = 1;       // +1 or -1
};

[[nodiscard]] constexpr bool is_allowed(const ModeSwitchConfig& c) noexcept {
    const auto is_number_of_ticks = [](std::int32_t n) { return n >= 1 && n <= 1 << 24; };
    const auto is_sign = [](std::int8_t x) { return x == 1 || x == -1; };
    return is_allowed(c.range) && is_number_of_ticks(c.gap_ticks) && is_number_of_ticks(c.settle_ticks) &&
           is_number_of_ticks(c.lock_timeout_ticks) && is_number_of_ticks(c.dark_ticks) && c.gap_min_ticks >= 0 &&
           c.gap_min_ticks <= c.gap_ticks && c.lock_timeout_ticks > c.settle_ticks &&
           c.lock_tolerance > Wavelengths{0.0} && c.lock_tolerance < Wavelengths{0.5} &&
           c.arrival_tolerance > Wavelengths{0.0} && c.arrival_tolerance < Wavelengths{0.25} &&
           c.start_set_point >= c.range.min && c.start_set_point <= c.range.max && is_sign(c.start_polarity);
}

// Four ticks, so that both signs of the bias weigh the same.
inline constexpr std::int32_t most_readings = 8;

// The last piezo readings in lock.
struct PiezoReadings {
    std::array<double, most_readings> voltage_v{};
    std::int32_t n = 0;     // readings held
    std::int32_t next = 0;  // place of the next one
    std::int32_t age = 0;   // halves since the last one

    friend constexpr bool operator==(const PiezoReadings&, const PiezoReadings&) = default;
};

struct ModeSwitchState {
    SwitchPhase phase = SwitchPhase::settling;
    bool loop_closed = true;       // command in force
    std::int8_t polarity = 1;      // command in force
    double set_point_v = 0.0;      // command in force
    std::int32_t n_halves = 0;     // since the loop was last opened or closed
    std::int32_t n_locked = 0;     // halves in a row: within the tolerance,
    std::int32_t n_lost = 0;       // dark or outside the tolerance,
    std::int32_t n_dark = 0;       // dark
    double detuning_lambda = 0.0;  // smoothed
    bool smoothing = false;        // `detuning_lambda` has begun
    PiezoReadings readings{};      // since the loop was closed
    double good_v = 0.0;           // U+, the place to return to
    std::int8_t good_polarity = 1;
    bool good_measured = false;  // U+ is a fresh mean of readings
    std::int32_t place = 0;      // of the search
    bool switching = false;      // an event is pending: it comes with the lock
    std::int64_t tick_opened = 0;

    friend constexpr bool operator==(const ModeSwitchState&, const ModeSwitchState&) = default;
};

struct ModeSwitchInput {
    bool due = false;            // open at the next tick border
    bool recentre = false;       // the same, because the range ends: the move teaches nothing
    bool reversed = false;       // the other helicity lases than was commanded
    bool tick_border = false;    // the half to come is the first of a tick
    std::int64_t next_tick = 0;  // that tick
    bool light_known = false;    // frame received, samples finite
    bool two_way = false;
    bool usable = false;  // `detuning` was measured
    Wavelengths detuning{};
    bool at_rest = false;     // the piezo is where it was sent
    Wavelengths in_flight{};  // detuning that the rest of the move adds, after the mean of this half
    Volts piezo{};            // reading; NaN when there is none
    Volts set_point{};        // the loop's present command: stands in for U+ when nothing was read
    Volts half_wave{};        // present estimate, > 0
    Volts offset{};  // added to a move in either direction: mean of the predicted moves up and down (hysteresis)
};

struct SwitchEvent {
    std::int64_t tick_opened = 0;
    SwitchOutcome outcome = SwitchOutcome::switched;
    bool has_half_wave = false;  // only of `switched`, with fresh readings before and after
    double half_wave_v = 0.0;    // |U- - U+|

    friend constexpr bool operator==(const SwitchEvent&, const SwitchEvent&) = default;
};

struct SwitchDirection {
    std::int8_t sign = 1;       // of U- - U+
    bool out_of_range = false;  // neither neighbour keeps the margin: this one has more room
};

// Which neighbour to switch to: the one inside the range, margin kept, and nearest to the middle of the range.
[[nodiscard]] SwitchDirection choose_direction(const PiezoRange& range, Volts now, Volts half_wave) noexcept;

[[nodiscard]] ModeSwitchState initial_state(const ModeSwitchConfig& config) noexcept;

// Advance by one half-period: what was seen of it in, what to command for the next in the state; the event, where a
// lock ends one.
//
// A switch: U+ is the mean of the last readings, polarity is inverted, U- = U+ + sign U_lambda/2 + offset goes to the
// second input, and the loop stays open for the gap. The lock that ends it measures |U- - U+|.
//
// config  passed `check`.
// state   from `initial_state`; finite, set-points within the range.
[[nodiscard]] std::optional<SwitchEvent> step(const ModeSwitchConfig& config, ModeSwitchState& state,
                                              const ModeSwitchInput& input) noexcept;

}  // namespace zlg::core
