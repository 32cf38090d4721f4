// expect: no match for .operator\+.*Volt.*Second
// The sum of a voltage and a time.

#include <zlg/core/units.hpp>

constexpr auto refused = zlg::core::Volts{40.0} + zlg::core::Seconds{1.0};
