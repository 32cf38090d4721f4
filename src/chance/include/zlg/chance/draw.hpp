#pragma once
// One number after the other from an address, of whatever law is wanted: for what is drawn once, as the gyro of a
// trial.
//
// Normal deviates and all others are counted by themselves, each from index 0 on: the first normal deviate of a Draw is
// that of index 0, whatever was drawn before. No more than 2^32 of either; then they repeat.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include <zlg/chance/address.hpp>

namespace zlg::chance {

// A number for a thing that has a name, to be the `thing` of a Draw (hash FNV-1a of 32 bits). Of a hundred names two
// have the same with a probability of 1e-6.
[[nodiscard]] constexpr std::uint32_t thing_of(std::string_view name) noexcept {
    std::uint32_t hash = 0x811c9dc5u;
    for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x01000193u;
    return hash;
}

class Draw {
public:
    // trial  below 2^48: the trial of a campaign.
    // thing  what is drawn for the trial, where it should not depend on what else is: an enumerator or thing_of(name).
    Draw(std::uint64_t seed, Cause cause, std::uint64_t trial = 0, std::uint32_t thing = 0) noexcept
        : address_{.seed = seed, .gyro = thing, .cause = cause, .half = trial} {}

    // 64 even bits.
    std::uint64_t bits() noexcept { return chance::bits(address_, n_taken_++); }

    // Evenly in [0, 1), in [least, most), and in the logarithm of the latter, both of one sign.
    double uniform() noexcept { return chance::uniform(address_, n_taken_++); }
    double within(double least, double most) noexcept { return least + (most - least) * uniform(); }
    double within_log(double least, double most) noexcept;

    // Zero mean and unit variance; mean 1; -1 or +1.
    double normal() noexcept;
    double exponential() noexcept;
    double sign() noexcept { return bits() >> 63 != 0 ? 1.0 : -1.0; }

    // 0..n-1, each with a probability that is off by at most 2^-64.
    std::size_t below(std::size_t n) noexcept { return bits() % n; }
    bool is_one_in(std::size_t n) noexcept { return below(n) == 0; }
    template <class Choice, std::size_t n> Choice one_of(const std::array<Choice, n>& choices) noexcept {
        return choices[below(n)];
    }

private:
    Address address_;
    std::uint32_t n_taken_ = 0;
    std::uint32_t n_normals_taken_ = 0;
    std::array<double, 32> normals_{};  // those from the latest multiple of so many on, as soon as one is taken
};

// The draws of one trial, each for a thing that has a name: one more changes no other.
struct Draws {
    std::uint64_t seed = 0;
    Cause cause{};
    std::uint64_t trial = 0;  // below 2^48

    [[nodiscard]] Draw of(std::string_view thing) const noexcept { return {seed, cause, trial, thing_of(thing)}; }
};

}  // namespace zlg::chance
