// expect: could not convert .*Arcsec.* to .*Celsius
// An angle where a temperature is asked for.

#include <zlg/core/units.hpp>

constexpr double kelvin(zlg::core::Celsius temperature) { return temperature.value() + 273.15; }

constexpr double refused = kelvin(zlg::core::Arcsec{3.263});
