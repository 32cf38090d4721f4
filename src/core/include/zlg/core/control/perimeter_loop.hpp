#pragma once
// The perimeter loop: hold the cavity on the centre of the mode that lases.
//
// digital  the processor integrates the detuning of each half. After a switch it first corrects nearly all it sees,
//          knowing what of its last command is still in flight through the high-voltage stage, then slows down.
// analog   electronics integrate; the processor gives the second input, which rules while the loop is open, and
// watches.
//
// While the loop is open, set-points lead the voltage to the second input as fast as the stage can, so that it arrives
// and stays. How fast that is, is learnt from one switch to the next.

#include <array>
#include <cstdint>

#include <zlg/core/control/piezo_range.hpp>
#include <zlg/core/records.hpp>
#include <zlg/core/units.hpp>

namespace zlg::core {

enum class LoopKind : unsigned char { analog, digital };

struct PerimeterLoopConfig {
    LoopKind kind = LoopKind::analog;
    PiezoRange range{};
    Volts half_wave{40.0};          // presumed; the loop's gain rests on it, not on the running estimate
    Seconds half_period{0.0025};    // time between calls of `step`
    Seconds time_constant{0.0065};  // of a small detuning's decay; at least `half_period`
    Wavelengths error_limit{0.09};  // what the integrator is given at most
    double slew_v_s = 4000.0;       // the most the set-point moves per second while the loop is closed
    Wavelengths watch_limit{0.1};   // larger detuning in a closed loop is reported

    // The high-voltage stage, and how finely it is led while the loop is open.
    Seconds stage_time_constant{0.001};  // RC; slew_v_s limits its current
    std::int32_t set_points = 16;        // a half, 1..max_set_points

    // Fast re-lock of a digital loop. Without it, the plain integrator.
    std::int32_t relock_halves = 0;  // after closing, 0..2^30; 0: none, and the gain is not used
    double relock_gain = 0.87;       // part of the detuning corrected a half: 1 - (1 - 0.12)^16; 0 exclusive..1
};

[[nodiscard]] constexpr bool is_allowed(const PerimeterLoopConfig& c) noexcept {
    return is_allowed(c.range) && c.half_wave >= Volts{1e-3} && c.half_wave <= Volts{1e6} &&
           c.half_period > Seconds{0.0} && c.half_period <= Seconds{1e3} && c.time_constant >= c.half_period &&
           c.time_constant <= Seconds{1e6} && c.error_limit > Wavelengths{0.0} && c.error_limit <= Wavelengths{1e3} &&
           c.slew_v_s > 0.0 && c.slew_v_s <= 1e12 && c.watch_limit > Wavelengths{0.0} && c.relock_halves >= 0 &&
           c.relock_halves <= 1 << 30 && c.relock_gain > 0.0 && c.relock_gain <= 1.0 &&
           c.stage_time_constant >= Seconds{1e-9} && c.stage_time_constant <= Seconds{1e3} && c.set_points >= 1 &&
           c.set_points <= max_set_points;
}

struct PerimeterLoopState {
    double set_point_v = 0.0;   // where the voltage shall be
    double mean_v = 0.0;        // presumed mean over the half now in force
    double end_v = 0.0;         // presumed, at its end
    double start_v = 0.0;       // presumed, at its start
    double opened_v = 0.0;      // presumed, when the loop was opened
    std::int32_t n_closed = 0;  // halves in force since the loop was closed
    double slew_ratio = 1.0;    // of the stage, learnt, over slew_v_s: 1/4..4
    double slew_error = 0.0;    // of it, as this switch shows it
    bool has_slew_error = false;

    friend constexpr bool operator==(const PerimeterLoopState&, const PerimeterLoopState&) = default;
};

struct PerimeterLoopInput {
    bool was_closed = true;   // the loop, in the half just latched
    bool close = true;        // the loop, in the half to come
    Volts second_input{0.0};  // set-point that rules while the loop is open
    bool usable = false;      // `detuning` was measured
    Wavelengths detuning{};   // mean over the half just latched
    Volts piezo{};            // reading; NaN when there is none
};

struct PerimeterLoopOutput {
    std::int32_t n_set_points = 1;                   // of the half to come, the last of them that of the state
    std::array<double, max_set_points> set_point_v;  // so many of them; the rest is not set
    bool over_limit = false;                         // closed, and detuned by more than the watch limit
    bool near_range_end = false;  // the piezo (the set-point, where there is no reading) is within the margin of an end
};

[[nodiscard]] constexpr PerimeterLoopState initial_state(const PerimeterLoopConfig& c, Volts set_point) noexcept {
    const double v = clamp(c.range, set_point).value();
    return {.set_point_v = v, .mean_v = v, .end_v = v, .start_v = v};
}

// Advance by one half-period.
//
//   closed, digital:  u <- u - clip((half_period/time_constant) clip(dl, error_limit) / kp, slew half_period)
//   closed, analog:   u held                  kp = 0.5/half_wave, wavelengths per volt
//   open:             u <- second_input       always: u within the range
//
// In a half through which the stage slews, slew_ratio is off by (v read - v presumed)/(v presumed - v at the opening).
// Half of that is applied when the loop is closed, if the voltage has arrived at the second input by then.
//
// With relock_halves, closed and digital, v the voltage that the presumed stage has made of past set-points:
//
//   p = dl + kp (u - mean of v)               the detuning to which u leads, what is in flight included
//   u <- u - relock_gain p/kp                 at closing and in the first relock_halves - 1 halves after it
//   u <- u - (half_period/time_constant) clip(p, error_limit)/kp      later
//
// The first correction rests on the last open half, whose light is already that of the new mode; it is left out where
// more than 0.1 wavelength of the move was then in flight. Within a half the set-points lead the voltage to u as fast
// as the current limit allows.
//
// Clamping u itself is the anti-windup: it leaves the end with the first detuning of the other sign. Opening presets u,
// so closing starts from the second input. A half whose detuning was not measured, or not in a closed loop, holds u.
//
// config   passed `check`.
// state    from `initial_state`; finite and within the range.
// latency  acts in the half after the one that was measured.
[[nodiscard]] PerimeterLoopOutput step(const PerimeterLoopConfig& config, PerimeterLoopState& state,
                                       const PerimeterLoopInput& input) noexcept;

}  // namespace zlg::core
