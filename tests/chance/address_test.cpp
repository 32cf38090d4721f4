// Numbers by address: each has its place, no two places share one, and their laws are those that the header states.

#include <zlg/chance/address.hpp>

#include "box_muller.hpp"
#include "philox.hpp"
#include "test.hpp"

namespace zlg::chance::address_test {

constexpr Address somewhere{
    .seed = 0x0123456789abcdefu, .gyro = 0x89abcdefu, .cause = Cause::test, .half = 0x765443211234u};

std::uint64_t bits_of(double x) { return std::bit_cast<std::uint64_t>(x); }

// The words as the layout in the header has them, written down by hand.
TEST(Address, TheCounterIsLaidOutAsDocumented) {
    const auto cause = static_cast<std::uint32_t>(Cause::test);
    const Block of_bits = philox({3, 0x89abcdefu, 0x43211234u, cause << 16 | 0x7654u}, somewhere.seed);
    EXPECT_EQ(bits(somewhere, 6), of_bits[0]);
    EXPECT_EQ(bits(somewhere, 7), of_bits[1]);
}

TEST(Address, UniformNumbersAreTheUpperBits) {
    for (std::uint32_t i = 0; i < 100; ++i)
        EXPECT_EQ(uniform(somewhere, i), std::ldexp(static_cast<double>(bits(somewhere, i) / 2048), -53));
}

TEST(Address, NormalsAreTheTransformOfTheBlocksThatTheLayoutNames) {
    const auto cause = static_cast<std::uint32_t>(Cause::test);
    for (std::uint32_t i = 0; i < 100; ++i) {
        const Block block = philox({0x80000000u + i, 0x89abcdefu, 0x43211234u, cause << 16 | 0x7654u}, somewhere.seed);
        std::array<double, 4> expected;
        transform(block, expected.data());
        for (std::uint32_t k = 0; k < 4; ++k) EXPECT_EQ(bits_of(normal(somewhere, 4 * i + k)), bits_of(expected[k]));
    }
}

// Computed by a program in Python, whose doubles are rounded by IEEE 754 like those of every machine.
TEST(Address, NormalsAreTheSameBitsOnEveryMachine) {
    const double expected[]{0x1.e1f82f81655a1p-1, -0x1.01303dd1ef5b1p-2, -0x1.7dcf0003962b5p-2, -0x1.a049a792178cep-2};
    for (std::uint32_t i = 0; i < 4; ++i) EXPECT_EQ(normal(somewhere, i), expected[i]);
    std::uint64_t digest = 0;
    for (std::uint64_t half = 0; half < 4000; ++half)
        for (std::uint32_t i = 0; i < 8; ++i)
            digest = (digest ^ bits_of(normal({.seed = 1, .cause = Cause::test, .half = half}, i))) * 0x100000001b3u;
    EXPECT_EQ(digest, 0x00e9bd7798338e8du);
}

TEST(Address, ManyNormalsAreThoseTakenOneByOne) {
    for (std::size_t n = 0; n <= 131; ++n) {
        std::vector<double> many(n + 1, 99.0);
        normals(somewhere, std::span{many}.first(n));
        EXPECT_EQ(many[n], 99.0) << n;
        for (std::size_t i = 0; i < n; ++i)
            ASSERT_EQ(bits_of(many[i]), bits_of(normal(somewhere, static_cast<std::uint32_t>(i))));
    }
}

TEST(Address, ManyNormalsCanBeginAtAnyMultipleOfFour) {
    for (const std::uint32_t first : {4u, 20u, 1'000'000u, 0xffffffc0u}) {
        std::vector<double> many(37);
        normals(somewhere, many, first);
        for (std::uint32_t i = 0; i < 37; ++i) ASSERT_EQ(bits_of(many[i]), bits_of(normal(somewhere, first + i)));
    }
}

TEST(Address, EveryFieldMakesOtherNumbers) {
    const auto changed = [](auto change) {
        Address a = somewhere;
        change(a);
        return a;
    };
    const std::vector<Address> all{
        somewhere,
        changed([](Address& a) { a.seed ^= 1; }),
        changed([](Address& a) { a.seed ^= std::uint64_t{1} << 63; }),
        changed([](Address& a) { a.gyro ^= 1; }),
        changed([](Address& a) { a.cause = Cause::light; }),
        changed([](Address& a) { a.half ^= 1; }),
        changed([](Address& a) { a.half ^= std::uint64_t{1} << 47; }),
    };
    std::vector<std::uint64_t> drawn;
    for (const Address& a : all)
        for (std::uint32_t i = 0; i < 64; ++i) {
            drawn.push_back(bits(a, i));
            drawn.push_back(bits_of(normal(a, i)));
        }
    std::ranges::sort(drawn);
    EXPECT_TRUE(std::ranges::adjacent_find(drawn) == drawn.end());
}

TEST(Address, UniformNumbersFillTheirInterval) {
    constexpr int n = 1'000'000;
    constexpr std::size_t cells = 1000;
    std::vector<int> counts(cells);
    for (std::uint32_t i = 0; i < n; ++i) {
        const double u = uniform(somewhere, i);
        ASSERT_TRUE(u >= 0.0 && u < 1.0);
        ++counts[static_cast<std::size_t>(u * cells)];
    }
    double chi_square = 0.0;
    for (const int count : counts) chi_square += (count - 1000.0) * (count - 1000.0) / 1000.0;
    EXPECT_NEAR(chi_square, cells - 1.0, 4.0 * std::sqrt(2.0 * cells));
}

// Correlation of normals along each way of the address: its standard error of n pairs is 1/sqrt(n).
TEST(Address, NeighboursAreUncorrelated) {
    constexpr int n = 400'000;
    const std::function<double(std::uint32_t)> ways[]{
        [](std::uint32_t i) { return normal(somewhere, i); },
        [](std::uint32_t i) { return normal({.seed = 1, .cause = Cause::test, .half = i}, 0); },
        [](std::uint32_t i) { return normal({.seed = i, .cause = Cause::test}, 1); },
        [](std::uint32_t i) { return normal({.seed = 1, .gyro = i, .cause = Cause::test}, 2); },
        [](std::uint32_t i) { return normal({.seed = i / 65536, .cause = static_cast<Cause>(i % 65536)}, 3); },
        [](std::uint32_t i) { return i % 2 == 0 ? normal(somewhere, i) : uniform(somewhere, i) - 0.5; },
    };
    for (const auto& way : ways)
        for (const std::uint32_t lag : {1u, 2u, 3u, 4u, 32u}) {
            double product = 0.0, squares = 0.0, square_product = 0.0;
            for (std::uint32_t i = 0; i < n; ++i) {
                const double a = way(i), b = way(i + lag);
                product += a * b;
                squares += b * b;
                square_product += (a * a - 1.0) * (b * b - 1.0);
            }
            EXPECT_NEAR(product / squares, 0.0, 4.5 / std::sqrt(n)) << &way - ways << " " << lag;
            if (&way != std::end(ways) - 1)
                EXPECT_NEAR(square_product / n, 0.0, 4.5 * 2.0 / std::sqrt(n)) << &way - ways << " " << lag;
        }
}

}  // namespace zlg::chance::address_test
