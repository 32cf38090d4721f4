#pragma once
// The methods that a configuration can name.

namespace zlg::core {

// Correction of the false drift after the perimeter loop is closed again.
enum class RelockMethod : unsigned char {
    none,
    frequency,    // from the measured bias frequency, eq (11)
    detuning,     // from the mean detuning of each half and an exponential loop, eqs (12)-(13)
    mean_square,  // from the mean square of the detuning of each half, without a loop model
    joint,        // detuning free-form in time from the light samples, weighed against the counts of the half-periods
};

// Part of a false angle by which `frequency` errs where the loop is not exponential, as it presumes: all ticks of a
// switch alike. Whole counts hide it.
inline constexpr double other_loop_part = 0.3;

// How the reversals of the bias are shifted against lock-in.
enum class DitherMethod : unsigned char {
    none,
    automatic,  // paired at low rates, random at high ones
    paired,
    random,
};

// What replaces the ticks of a gap.
enum class BridgeMethod : unsigned char {
    none,  // the ticks pass as read
    constant,
    linear,
    quadratic,
    automatic,  // the estimate of the switch, by the learnt motion
};

// The polynomial order of a method, or the highest that it may fall back to; 0 for `none`.
[[nodiscard]] constexpr int order_of(BridgeMethod method) noexcept {
    switch (method) {
        case BridgeMethod::none:
        case BridgeMethod::constant: return 0;
        case BridgeMethod::linear: return 1;
        case BridgeMethod::quadratic:
        case BridgeMethod::automatic: break;
    }
    return 2;
}

}  // namespace zlg::core
