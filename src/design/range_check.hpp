#pragma once
// Refusal of a number that is out of range, in one line that names it.

#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include <zlg/design/error.hpp>

namespace zlg::design {

[[noreturn, gnu::noinline]] inline void refuse(std::string_view where, std::string_view name, double value,
                                               std::string_view allowed) {
    throw DesignError(fmt::format("{}: {} is {}, allowed is {}", where, name, value, allowed));
}

// Written so that NaN fails.
inline void require(bool good, std::string_view where, std::string_view name, double value, std::string_view allowed) {
    if (!good) refuse(where, name, value, allowed);
}

inline void require_positive(std::string_view where, std::string_view name, double value) {
    require(value > 0.0 && std::isfinite(value), where, name, value, "a finite number above 0");
}

inline void require_not_negative(std::string_view where, std::string_view name, double value) {
    require(value >= 0.0 && std::isfinite(value), where, name, value, "a finite number from 0");
}

inline void require_finite(std::string_view where, std::string_view name, double value) {
    require(std::isfinite(value), where, name, value, "a finite number");
}

}  // namespace zlg::design
