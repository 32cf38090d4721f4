#pragma once
// The methods that a configuration can name.

namespace zlg::core {

// Correction of the false drift after the perimeter loop is closed again.
enum class RelockMethod : unsigned char {
    none,
    frequency,    // from the measured bias frequency, eq (11)
    detuning,     // from the mean detuning of each half and an exponential loop, eqs (12)-(13)
    mean_square,  // from the mean square of the detuning of each half, without a loop model
};

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
};

// The polynomial order of a method; 0 for `none`.
[[nodiscard]] constexpr int order_of(BridgeMethod method) noexcept {
    return method == BridgeMethod::quadratic ? 2 : method == BridgeMethod::linear ? 1 : 0;
}

}  // namespace zlg::core
