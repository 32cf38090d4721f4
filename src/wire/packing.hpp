#pragma once
// Numbers as the bytes of a frame, the lowest first, whatever the processor does, and back; reals as IEEE 754 binary64
// and binary32.

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include <zlg/wire/frame.hpp>

namespace zlg::wire {

// As many bytes as the number has; a bool is a bit of a byte, not a number.
template <class Number>
requires(!std::same_as<Number, bool>) using BitsOf =
    std::conditional_t<sizeof(Number) == 8, std::uint64_t,
                       std::conditional_t<sizeof(Number) == 4, std::uint32_t,
                                          std::conditional_t<sizeof(Number) == 2, std::uint16_t, std::uint8_t>>>;

class Packer {
public:
    template <class... Numbers> void operator()(const Numbers&... numbers) noexcept {
        (put(std::bit_cast<BitsOf<Numbers>>(numbers)), ...);
    }

    [[nodiscard]] std::span<const std::uint8_t> body() const noexcept { return std::span{bytes_}.first(n_); }

private:
    template <class Bits> void put(Bits x) noexcept {
        for (std::size_t k = 0; k < sizeof x && n_ < bytes_.size(); ++k)
            bytes_[n_++] = static_cast<std::uint8_t>(x >> (8 * k));
    }

    std::array<std::uint8_t, max_message_bytes> bytes_{};
    std::size_t n_ = 0;
};

// Past the end every number is 0.
class Unpacker {
public:
    explicit Unpacker(std::span<const std::uint8_t> bytes) noexcept : left_{bytes} {}

    template <class... Numbers> void operator()(Numbers&... numbers) noexcept {
        ((numbers = std::bit_cast<Numbers>(taken<BitsOf<Numbers>>())), ...);
    }

private:
    template <class Bits> [[nodiscard]] Bits taken() noexcept {
        std::uint64_t x = 0;
        for (std::size_t k = 0; k < sizeof(Bits) && k < left_.size(); ++k) x |= std::uint64_t{left_[k]} << (8 * k);
        left_ = left_.subspan(sizeof(Bits) < left_.size() ? sizeof(Bits) : left_.size());
        return static_cast<Bits>(x);
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
