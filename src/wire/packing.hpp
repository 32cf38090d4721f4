#pragma once
// Numbers as bytes, the lowest first, whatever the processor does; reals as IEEE 754 binary64 and binary32.

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include <zlg/wire/frame.hpp>

namespace zlg::wire {

class Packer {
public:
    void u8(std::uint8_t x) noexcept { put(x, 1); }
    void u16(std::uint16_t x) noexcept { put(x, 2); }
    void u32(std::uint32_t x) noexcept { put(x, 4); }
    void u64(std::uint64_t x) noexcept {
        put(static_cast<std::uint32_t>(x), 4);
        put(static_cast<std::uint32_t>(x >> 32), 4);
    }
    void i8(std::int8_t x) noexcept { u8(static_cast<std::uint8_t>(x)); }
    void f32(float x) noexcept { u32(std::bit_cast<std::uint32_t>(x)); }
    void f64(double x) noexcept { u64(std::bit_cast<std::uint64_t>(x)); }

    [[nodiscard]] std::span<const std::uint8_t> body() const noexcept { return std::span{bytes_}.first(n_); }

private:
    void put(std::uint32_t x, int n) noexcept {
        for (int k = 0; k < n && n_ < bytes_.size(); ++k) {
            bytes_[n_++] = static_cast<std::uint8_t>(x);
            x >>= 8;
        }
    }

    std::array<std::uint8_t, max_body_bytes> bytes_{};
    std::size_t n_ = 0;
};

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
