#pragma once
// Numbers as the bytes of a frame's body, the lowest first, whatever the processor does; reals as IEEE 754 binary64 and binary32.

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

}  // namespace zlg::wire
