#pragma once
// Bytes of a frame as the numbers that were packed, and which of these can be.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace zlg::wire {

// Past the end every number is 0.
class Unpacker {
public:
    explicit Unpacker(std::span<const std::uint8_t> bytes) noexcept : left_{bytes} {}

    [[nodiscard]] std::uint8_t u8() noexcept { return static_cast<std::uint8_t>(take(1)); }
    [[nodiscard]] std::uint16_t u16() noexcept { return static_cast<std::uint16_t>(take(2)); }
    [[nodiscard]] std::uint32_t u32() noexcept { return take(4); }
    [[nodiscard]] std::uint64_t u64() noexcept {
        const std::uint64_t low = take(4);
        return low | std::uint64_t{take(4)} << 32;
    }
    [[nodiscard]] std::int8_t i8() noexcept { return static_cast<std::int8_t>(u8()); }
    [[nodiscard]] float f32() noexcept { return std::bit_cast<float>(u32()); }
    [[nodiscard]] double f64() noexcept { return std::bit_cast<double>(u64()); }

private:
    std::uint32_t take(std::size_t n) noexcept {
        std::uint32_t x = 0;
        for (std::size_t k = 0; k < n && k < left_.size(); ++k) x |= std::uint32_t{left_[k]} << (8 * k);
        left_ = left_.subspan(n < left_.size() ? n : left_.size());
        return x;
    }

    std::span<const std::uint8_t> left_;
};

// Not so: NaN and infinities.
[[nodiscard]] constexpr bool is_number(double x) noexcept {
    constexpr std::uint64_t exponent = 0x7FF0'0000'0000'0000u;
    return (std::bit_cast<std::uint64_t>(x) & exponent) != exponent;
}

[[nodiscard]] constexpr bool is_sign(std::int8_t x) noexcept { return x == 1 || x == -1; }

}  // namespace zlg::wire
