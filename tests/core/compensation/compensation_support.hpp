#pragma once
// What the tests of the compensation share: random numbers that are the same on every machine, and wide arithmetic.

#include "support.hpp"

namespace compensation_test {

__extension__ typedef __int128 Integer128;
__extension__ typedef __float128 Quad;  // 113 bits

using zlg::core::not_a_number;
inline constexpr double infinite = std::numeric_limits<double>::infinity();

inline Quad magnitude(Quad x) { return x < 0 ? -x : x; }

// The generator is specified by the language, its distributions are not: they are written out.
class Random {
public:
    explicit Random(std::uint64_t seed) : bits_{seed} {}

    std::uint64_t bits() { return bits_(); }
    double uniform(double from, double to) { return from + (to - from) * static_cast<double>(bits() >> 11) * 0x1p-53; }
    bool chance(double probability) { return uniform(0.0, 1.0) < probability; }

    std::int64_t integer(std::int64_t from, std::int64_t to) {
        const std::uint64_t range = static_cast<std::uint64_t>(to) - static_cast<std::uint64_t>(from) + 1;
        return from + static_cast<std::int64_t>(bits() % range);
    }
    int index(int from, int to) { return static_cast<int>(integer(from, to)); }

    double normal() {
        const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform(0.0, 1.0)));
        return radius * std::cos(6.283185307179586 * uniform(0.0, 1.0));
    }

private:
    std::mt19937_64 bits_;
};

// Mean and variance of a few thousand trials.
class Statistics {
public:
    void add(double x) {
        ++n_;
        const double before = x - mean_;
        mean_ += before / n_;
        squares_ += before * (x - mean_);
    }
    double mean() const { return mean_; }
    double variance() const { return squares_ / (n_ - 1); }

private:
    int n_ = 0;
    double mean_ = 0.0;
    double squares_ = 0.0;
};

// Distance of a double from the exact value, in units of the exact value's last place as a double.
inline double ulps(double got, long double exact) {
    if (static_cast<long double>(got) == exact) return 0.0;
    int exponent = 0;
    std::frexp(exact, &exponent);
    const int last_place = exponent - 53 < -1074 ? -1074 : exponent - 53;
    return static_cast<double>(std::fabs(static_cast<long double>(got) - exact) / std::ldexp(1.0L, last_place));
}

}  // namespace compensation_test
