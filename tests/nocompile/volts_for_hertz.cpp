// expect: could not convert .*Volts.* to .*Hertz|could not convert .*VoltUnit.* to .*HertzUnit
// A voltage where a frequency is asked for.

#include <zlg/core/units.hpp>

constexpr double period_s(zlg::core::Hertz frequency) { return 1.0 / frequency.value(); }

constexpr double refused = period_s(zlg::core::Volts{40.0});
