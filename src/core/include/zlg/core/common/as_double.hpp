#pragma once
// The conversion of counts and ticks into a real number.

#include <cstddef>
#include <cstdint>

namespace zlg::core {

// A whole number, rounded once. In two parts where no instruction takes 64 bits: the sum is what rounds.
[[nodiscard]] constexpr double as_double(std::int64_t x) noexcept {
    if constexpr (sizeof(std::size_t) >= sizeof(x)) return static_cast<double>(x);
    const auto high = static_cast<std::int32_t>(x >> 32);
    const auto low = static_cast<std::uint32_t>(x);
    return high * 0x1p32 + low;
}

}  // namespace zlg::core
