#pragma once
// Noise of one cause, by the half-period that it belongs to: what one cause draws changes no other.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <zlg/chance/address.hpp>

namespace zlg::twin {

// Drawn where it is needed.
class Noise {
public:
    Noise(std::uint64_t seed, chance::Cause cause, std::uint32_t thing = 0)
        : address_{.seed = seed, .gyro = thing, .cause = cause} {}

    // Zero mean, unit variance: deviates 0, 1, ... of a half.
    void gauss(std::uint64_t half, std::span<double> out) const { chance::normals(at(half), out); }
    [[nodiscard]] double gauss(std::uint64_t half, std::uint32_t index) const {
        return chance::normal(at(half), index);
    }
    // Uniform in [0, 1).
    [[nodiscard]] double uniform(std::uint64_t half, std::uint32_t index) const {
        return chance::uniform(at(half), index);
    }

private:
    [[nodiscard]] chance::Address at(std::uint64_t half) const {
        chance::Address address = address_;
        address.half = half;
        return address;
    }

    chance::Address address_;
};

// Drawn for many halves at once, where each half takes as many: a deviate in a block of 64 costs far less than one by
// itself. The address of half h is that of block h/(64/each), index each (h mod 64/each) on.
template <std::size_t each> class NoiseAhead {
public:
    NoiseAhead(std::uint64_t seed, chance::Cause cause) : noise_{seed, cause} {}

    // Zero mean, unit variance. For halves in any order, at best rising.
    double gauss(std::uint64_t half, std::size_t index = 0) {
        const std::uint64_t block = half / halves;
        if (block != block_ || !is_drawn_) {
            noise_.gauss(block, drawn_);
            block_ = block;
            is_drawn_ = true;
        }
        return drawn_[each * static_cast<std::size_t>(half % halves) + index];
    }

private:
    static constexpr std::size_t halves = 64 / each;

    Noise noise_;
    std::uint64_t block_ = 0;
    bool is_drawn_ = false;
    std::array<double, each * halves> drawn_{};
};

}  // namespace zlg::twin
