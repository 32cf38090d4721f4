#pragma once
// What can go wrong in the design calculations: a parameter that no gyro and no run can have.

#include <stdexcept>

namespace zlg::design {

// One line: which parameter, its value, what is allowed.
struct DesignError : std::invalid_argument {
    using std::invalid_argument::invalid_argument;
};

}  // namespace zlg::design
