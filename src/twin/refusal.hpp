#pragma once
// How a number is refused: what it is called, its value, what is allowed.

#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

namespace zlg::twin {

[[noreturn]] inline void refuse(std::string_view name, double value, std::string_view allowed) {
    throw std::invalid_argument(fmt::format("{} is {}, allowed is {}", name, value, allowed));
}

inline void require_within(std::string_view name, double value, double min, double max) {
    if (!(value >= min && value <= max)) refuse(name, value, fmt::format("{}..{}", min, max));
}

}  // namespace zlg::twin
