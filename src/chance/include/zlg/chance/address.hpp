#pragma once
// Random numbers by address: each is a function of where it belongs, not of how many were drawn before it. See
// docs/same_run.md.
//
// The generator is Philox4x32-10 (philox.hpp). Its key is the seed; its counter of 128 bits is
//
//   bits 127..112  cause
//        111..64   half
//         63..32   gyro
//             31   1: normal deviates, 0: bits and uniform numbers
//         30..0    block: index/4 of normal deviates, index/2 of bits and uniform numbers
//
// Different addresses, and the two kinds at one address, have no block in common. Bits and uniform numbers of one index
// are the same number. All functions give the same bits on every machine.

#include <cstdint>
#include <span>

#include <zlg/chance/causes.hpp>

namespace zlg::chance {

struct Address {
    std::uint64_t seed = 0;
    std::uint32_t gyro = 0;
    Cause cause{};
    // Half-period or trial, below 2^48 (22 000 years): asserted; without assertions numbers repeat from there on.
    std::uint64_t half = 0;

    friend bool operator==(const Address&, const Address&) = default;
};

// 64 random bits.
[[nodiscard]] std::uint64_t bits(const Address& address, std::uint32_t index) noexcept;

// Uniform in [0, 1): a multiple of 2^-53, the upper 53 of the bits.
[[nodiscard]] double uniform(const Address& address, std::uint32_t index) noexcept;

// Normal deviate of zero mean and unit variance.
//
// Box and Muller's transform (G. E. P. Box, M. E. Muller, Ann. Math. Stat. 29, 1958, 610) of 64 bits makes two of them,
// x and y:
//
//   u = (k + 1/2) 2^-40, k of 40 bits         phi = (pi/4)(2 (j + 1/2) 2^-22 - 1), j of 22 bits
//   x = +-sqrt(-ln u) (cos phi - sin phi)     y = +-sqrt(-ln u) (cos phi + sin phi), a bit for each sign
//
// that is r cos and r sin of r = sqrt(-2 ln u) and an angle from a grid of 2^-24 turns, half a step off the axes. As a
// law:
// - |x| <= sqrt(82 ln 2) = 7.54
// - the variance is 1 - ln 2/2^41, mean, skewness and all other odd moments are zero
// - the distribution function departs from the normal one at x by at most 2^-41 + min(2^-24, 1.4e-14/|x|), and the
//   part beyond x is too small by 5e-9 of itself at x = 5, 2e-6 at 6, 0.3 % at 7
// - computed to 1e-10 of the radius, which is far finer than the grid of the angle
[[nodiscard]] double normal(const Address& address, std::uint32_t index) noexcept;

// The normal deviates first, first + 1, ... of the address, bit for bit those that normal() gives. Many at once cost
// less each.
//
// first  a multiple of 4: asserted; no index may pass 2^32.
void normals(const Address& address, std::span<double> out, std::uint32_t first = 0) noexcept;

}  // namespace zlg::chance
