// expect: success
// What the other files misuse, used rightly.

#include <zlg/core/units.hpp>

constexpr zlg::core::Volts half(zlg::core::Volts voltage) { return 0.5 * voltage; }

static_assert(half(zlg::core::Volts{40.0}).value() == 20.0);
static_assert(zlg::core::Volts{1.0} + zlg::core::Volts{2.0} == zlg::core::Volts{3.0});
static_assert(zlg::core::Seconds{1.0} < zlg::core::Seconds{2.0});
