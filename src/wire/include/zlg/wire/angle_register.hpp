#pragma once
// The integrated angle as it goes over the line: a fixed-point number that wraps, so that nothing is lost with a
// message.

#include <bit>
#include <cstdint>

namespace zlg::wire {

// Exact sum of doubles modulo 2^36 arcsec, in units of 2^-92 arcsec.
//
// What goes over the line is the upper word: units of 2^-28 arcsec (3.7e-9), rounded down. The difference of two
// readings is the rotation between them as long as that is less than 2^35 arcsec: 6.6 hours at 400 deg/s.
struct AngleRegister {
    std::uint64_t high = 0;
    std::uint64_t low = 0;

    friend constexpr bool operator==(const AngleRegister&, const AngleRegister&) = default;

    // Bits below 2^-92 arcsec are cut off; what is not finite is not added.
    constexpr void add(double arcsec) noexcept {
        const auto bits = std::bit_cast<std::uint64_t>(arcsec);
        const int exponent = static_cast<int>((bits >> 52) & 0x7FF);
        if (exponent == 0 || exponent == 0x7FF) return;
        const std::uint64_t size = (bits & ((std::uint64_t{1} << 52) - 1)) | (std::uint64_t{1} << 52);
        AngleRegister part = shifted(size, exponent - 1075 + 92);
        if ((bits >> 63) != 0) part = negative(part);
        add(part);
    }
    constexpr void add(const AngleRegister& part) noexcept {
        low += part.low;
        high += part.high + (low < part.low ? 1u : 0u);
    }

private:
    static constexpr AngleRegister shifted(std::uint64_t size, int by) noexcept {
        if (by <= -64 || by >= 128) return {};
        if (by < 0) return {0, size >> -by};
        if (by >= 64) return {size << (by - 64), 0};
        return {by == 0 ? 0 : size >> (64 - by), size << by};
    }
    static constexpr AngleRegister negative(const AngleRegister& a) noexcept {
        return {~a.high + (a.low == 0 ? 1u : 0u), ~a.low + 1u};
    }
};

inline constexpr double register_unit_arcsec = 0x1p-28;

// The rotation from one reading to a later one.
[[nodiscard]] constexpr double turned_arcsec(std::uint64_t from, std::uint64_t to) noexcept {
    return static_cast<double>(static_cast<std::int64_t>(to - from)) * register_unit_arcsec;
}

}  // namespace zlg::wire
