#pragma once
// What a row must hold, and the words in which a reader of either format complains.

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

namespace zlg::logs {

// Counts up to here, and the sum of two of them, are exact in a double.
inline constexpr std::int64_t max_counts = std::int64_t{1} << 52;

inline constexpr std::string_view allowed_sign = "+1 or -1";
inline constexpr std::string_view allowed_flag = "0 or 1";
inline constexpr std::string_view not_finite = "is not finite; allowed is a finite number";
inline constexpr std::string_view not_a_number = "is not a number; allowed is a number or inf";
inline constexpr std::string_view sigma_below_zero = "is negative; allowed is 0 or more, or inf";

// Of an index that is not the expected one.
[[nodiscard]] std::string out_of_order(std::int64_t value, std::int64_t expected);

// Of a bias sign that is the one of the row before.
[[nodiscard]] std::string not_alternating(std::int64_t value);

[[nodiscard]] std::string out_of_range(std::string_view allowed);
[[nodiscard]] std::string range(std::int64_t min, std::int64_t max);

// On the bits, so that a loop over a column is vectorised.
[[nodiscard]] constexpr bool is_finite(double value) {
    constexpr std::uint64_t exponent = 0x7FF0'0000'0000'0000u;
    return (std::bit_cast<std::uint64_t>(value) & exponent) != exponent;
}
[[nodiscard]] constexpr bool is_finite(float value) {
    constexpr std::uint32_t exponent = 0x7F80'0000u;
    return (std::bit_cast<std::uint32_t>(value) & exponent) != exponent;
}

}  // namespace zlg::logs
