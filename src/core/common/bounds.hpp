#pragma once
// Small arithmetic that the sources of the core share.

#include <cstdint>

namespace zlg::core {

template <class Number> [[nodiscard]] constexpr Number limited(Number x, Number limit) noexcept {
    if (x > limit) return limit;
    return x < -limit ? -limit : x;
}

[[nodiscard]] constexpr double size(double x) noexcept { return __builtin_fabs(x); }

[[nodiscard]] constexpr double square(double x) noexcept { return x * x; }

[[nodiscard]] constexpr double larger(double a, double b) noexcept { return a > b ? a : b; }

[[nodiscard]] constexpr bool is_within(double x, double min, double max) noexcept { return x >= min && x <= max; }

// A counter that stops at its end instead of wrapping.
constexpr void count_up(std::int32_t& n) noexcept {
    if (n < INT32_MAX) ++n;
}

// Halves in a row of which this is true.
constexpr void count_row(std::int32_t& n, bool so) noexcept {
    if (!so)
        n = 0;
    else
        count_up(n);
}

// True once the condition has held in `enough` calls in a row.
[[nodiscard]] constexpr bool debounced(std::int32_t& n, bool so, std::int32_t enough) noexcept {
    n = so ? n + (n < enough) : 0;
    return n >= enough;
}

}  // namespace zlg::core
