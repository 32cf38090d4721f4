#pragma once
// What every test of the core includes.

#include <zlg/core/common/maths.hpp>

#include "test.hpp"

namespace zlg::core::test {

// What `check` says of a configuration that was changed.
template <class Config> constexpr auto fault_of(auto change, Config c = {}) {
    change(c);
    return check(c);
}

// Whether a configuration that was changed is allowed.
template <class Config> constexpr bool allows(auto change, Config c = {}) {
    change(c);
    return is_allowed(c);
}

}  // namespace zlg::core::test
