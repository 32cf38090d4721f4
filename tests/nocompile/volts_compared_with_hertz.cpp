// expect: no match for .operator<.*Volt.*Hertz
// A voltage compared with a frequency.

#include <zlg/core/units.hpp>

constexpr bool refused = zlg::core::Volts{40.0} < zlg::core::Hertz{1.0};
