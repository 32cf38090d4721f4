// expect: cannot convert .*Volt.* to .*double
// A voltage where a bare number is asked for: the way out has a name.

#include <zlg/core/units.hpp>

constexpr double refused = zlg::core::Volts{40.0};
