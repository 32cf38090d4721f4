// A hash over the bits of the core's elementary functions, for bench/maths_bits: the same on every machine.

#include <bit>
#include <cstdint>
#include <cstdio>

#include <zlg/core/common/maths.hpp>

namespace {

namespace maths = zlg::core::maths;

// Knuth's generator of 64 bits, of which the upper ones are good.
class Points {
public:
    // Any double in one case of two, else a number in -20..20.
    double next() {
        const std::uint64_t any = bits();
        return (any & 1u) != 0 ? std::bit_cast<double>(bits())
                               : static_cast<double>(any >> 11) * (40.0 * 0x1p-53) - 20.0;
    }

private:
    std::uint64_t bits() {
        const std::uint64_t upper = step() >> 32;
        return (upper << 32) | (step() >> 32);
    }
    std::uint64_t step() { return state_ = state_ * 6364136223846793005u + 1442695040888963407u; }

    std::uint64_t state_ = 1;
};

// Fowler, Noll and Vo's hash of whole numbers. What bits a NaN has, processors do not agree on.
void add(std::uint64_t& hash, double x) {
    const std::uint64_t bits = x == x ? std::bit_cast<std::uint64_t>(x) : 1u;
    hash = (hash ^ (bits >> 32)) * 1099511628211u;
    hash = (hash ^ (bits & 0xffffffffu)) * 1099511628211u;
}

}  // namespace

int main() {
    constexpr int n_points = 200'000;
    Points points;
    std::uint64_t hash = 14695981039346656037u;
    for (int k = 0; k < n_points; ++k) {
        const double x = points.next();
        const double y = points.next();
        const double values[] = {maths::exp(x),  maths::expm1(x),    maths::log(x),  maths::sin(x),
                                 maths::cos(x),  maths::atan2(y, x), maths::asin(x), maths::asin(0.05 * x),
                                 maths::tanh(x), maths::hypot(x, y)};
        for (const double value : values) add(hash, value);
    }
    std::printf("%08lx%08lx\n", static_cast<unsigned long>(hash >> 32), static_cast<unsigned long>(hash & 0xffffffffu));
}
