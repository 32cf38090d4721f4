// expect: no match for .operator\*
// A product of two quantities has a unit that no type here knows: it is written out on the values.

#include <zlg/core/units.hpp>

constexpr auto refused = zlg::core::Hertz{2.0} * zlg::core::Seconds{1.0};
