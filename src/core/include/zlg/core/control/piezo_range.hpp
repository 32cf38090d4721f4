#pragma once
// The voltages that the high-voltage stage can give to the piezo mirrors.

#include <zlg/core/units.hpp>

namespace zlg::core {

struct PiezoRange {
    Volts min{0.0};
    Volts max{300.0};
    Volts margin{10.0};  // room for thermal drift until the next switch: nearer to an end is reported

    friend constexpr bool operator==(const PiezoRange&, const PiezoRange&) = default;
};

[[nodiscard]] constexpr bool is_allowed(const PiezoRange& r) noexcept {
    return r.min > Volts{-1e6} && r.max < Volts{1e6} && r.min < r.max && r.margin >= Volts{0.0} &&
           2.0 * r.margin < r.max - r.min;
}

// The voltage of the range that is nearest to `voltage`; the lower end for NaN.
[[nodiscard]] constexpr Volts clamp(const PiezoRange& r, Volts voltage) noexcept {
    if (!(voltage > r.min)) return r.min;
    return voltage < r.max ? voltage : r.max;
}

// Nearer to an end than the margin, or beyond it; false for NaN.
[[nodiscard]] constexpr bool near_end(const PiezoRange& r, Volts voltage) noexcept {
    return voltage < r.min + r.margin || voltage > r.max - r.margin;
}

// A reading that can be of this stage: at most one whole range outside the range. False for NaN and infinities.
[[nodiscard]] constexpr bool plausible(const PiezoRange& r, Volts voltage) noexcept {
    const Volts span = r.max - r.min;
    return voltage >= r.min - span && voltage <= r.max + span;
}

}  // namespace zlg::core
