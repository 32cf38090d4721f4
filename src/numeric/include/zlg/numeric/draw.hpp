#pragma once
// Random numbers of one seed.
//
// The distributions are Boost's: those of the standard library may differ from one library to the next.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_01.hpp>

namespace zlg::numeric {

class Draw {
public:
    explicit Draw(std::uint64_t seed) : engine_{seed} {}

    // 64 even bits.
    std::uint64_t bits() { return engine_(); }

    // Evenly in [0, 1), in [least, most), and in the logarithm of the latter, both of one sign.
    double uniform() { return uniform_(engine_); }
    double within(double least, double most) { return least + (most - least) * uniform(); }
    double within_log(double least, double most) { return least * std::pow(most / least, uniform()); }

    // Zero mean and unit variance; mean 1; -1 or +1.
    double normal() { return normal_(engine_); }
    double exponential() { return -std::log(1.0 - uniform()); }
    double sign() { return uniform() < 0.5 ? -1.0 : 1.0; }

    // 0..n-1, for an n far below 2^64.
    std::size_t below(std::size_t n) { return engine_() % n; }
    bool is_one_in(std::size_t n) { return below(n) == 0; }
    template <class Choice, std::size_t n>
    Choice one_of(const std::array<Choice, n>& choices) {
        return choices[below(n)];
    }

private:
    boost::random::mt19937_64 engine_;
    boost::random::normal_distribution<double> normal_;
    boost::random::uniform_01<double> uniform_;
};

}  // namespace zlg::numeric
