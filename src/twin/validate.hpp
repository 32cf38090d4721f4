#pragma once

#include <zlg/twin/twin_config.hpp>

namespace zlg::twin {

// Refuse what the arithmetic cannot carry.
//
// errors  std::invalid_argument: the key that the member has in a configuration, value, allowed.
void validate(const TwinConfig& config);

}  // namespace zlg::twin
