// expect: could not convert .*double.* to .*Volt
// A bare number where a voltage is asked for: nobody sees its unit.

#include <zlg/core/units.hpp>

constexpr double magnitude_v(zlg::core::Volts voltage) { return voltage.value(); }

constexpr double refused = magnitude_v(40.0);
