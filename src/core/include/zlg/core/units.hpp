#pragma once
// Quantities that cross a module border: an explicit way in, a named way out.
//
// Only addition, scaling and comparison are defined. A product of two quantities is physics, so it is written
// out on `.value()`, under its equation, where the reader sees the unit of the result.

#include <compare>

namespace zlg::core {

template <class Unit> class Quantity {
public:
    constexpr Quantity() = default;
    constexpr explicit Quantity(double value) : value_{value} {}

    [[nodiscard]] constexpr double value() const { return value_; }

    friend constexpr auto operator<=>(Quantity, Quantity) = default;
    // Without the detour by an ordering, which costs several instructions where the others cost one.
    friend constexpr bool operator<(Quantity a, Quantity b) { return a.value_ < b.value_; }
    friend constexpr bool operator>(Quantity a, Quantity b) { return a.value_ > b.value_; }
    friend constexpr bool operator<=(Quantity a, Quantity b) { return a.value_ <= b.value_; }
    friend constexpr bool operator>=(Quantity a, Quantity b) { return a.value_ >= b.value_; }
    friend constexpr Quantity operator+(Quantity a, Quantity b) { return Quantity{a.value_ + b.value_}; }
    friend constexpr Quantity operator-(Quantity a, Quantity b) { return Quantity{a.value_ - b.value_}; }
    friend constexpr Quantity operator*(double k, Quantity a) { return Quantity{k * a.value_}; }

private:
    double value_ = 0.0;
};

using Seconds = Quantity<struct SecondUnit>;
using Hertz = Quantity<struct HertzUnit>;
using Volts = Quantity<struct VoltUnit>;
using Celsius = Quantity<struct CelsiusUnit>;
using Wavelengths = Quantity<struct WavelengthUnit>;  // perimeter detuning, fractions of the laser wavelength
using Arcsec = Quantity<struct ArcsecUnit>;           // 1 arcsec/s is 1 deg/h exactly
using ArcsecPerRootSecond = Quantity<struct ArcsecPerRootSecondUnit>;  // angle random walk

}  // namespace zlg::core
