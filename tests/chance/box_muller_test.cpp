// The transform against long double, at the ends of its grids and between them.

#include "box_muller.hpp"
#include "test.hpp"

namespace zlg::chance::box_muller_test {

constexpr std::uint64_t radii = std::uint64_t{1} << 40;
constexpr std::uint64_t angles = std::uint64_t{1} << 22;

constexpr std::uint64_t word(std::uint64_t k, std::uint64_t j, std::uint64_t signs) { return k << 24 | j << 2 | signs; }

std::array<double, 2> pair_of(std::uint64_t word) {
    std::array<double, 2> pair;
    transform(std::array{word}, pair.data());
    return pair;
}

// r cos a and r sin a of the radius sqrt(-2 ln u) and the angle of the first quadrant that the header gives.
void expect_transform(std::uint64_t w) {
    const long double u = std::ldexp(static_cast<long double>(w >> 24) + 0.5L, -40);
    const long double r = std::sqrt(-2.0L * std::log(u));
    const long double a = 0.5L * std::numbers::pi_v<long double> *
                          std::ldexp(static_cast<long double>(w >> 2 & (angles - 1)) + 0.5L, -22);
    const auto [x, y] = pair_of(w);
    const auto allowed = static_cast<double>(1e-10L * r);
    ASSERT_NEAR(x, static_cast<double>((w & 1) != 0 ? -r * std::cos(a) : r * std::cos(a)), allowed) << w;
    ASSERT_NEAR(y, static_cast<double>((w & 2) != 0 ? -r * std::sin(a) : r * std::sin(a)), allowed) << w;
}

TEST(BoxMuller, IsTheTransformToATenBillionthOfTheRadius) {
    std::mt19937_64 random{1};
    for (int trial = 0; trial < 200'000; ++trial) expect_transform(random());
}

TEST(BoxMuller, HoldsAtTheEndsOfItsGrids) {
    for (const std::uint64_t k : {std::uint64_t{0}, std::uint64_t{1}, radii / 2 - 1, radii / 2, radii - 2, radii - 1})
        for (const std::uint64_t j :
             {std::uint64_t{0}, std::uint64_t{1}, angles / 2 - 1, angles / 2, angles - 2, angles - 1})
            for (std::uint64_t signs = 0; signs < 4; ++signs) expect_transform(word(k, j, signs));
}

TEST(BoxMuller, ReachesSevenAndAHalfSigmaAndNoFurther) {
    const double largest = std::sqrt(82.0 * std::numbers::ln2);
    EXPECT_NEAR(pair_of(word(0, 0, 0))[0], largest, 1e-9);
    EXPECT_NEAR(pair_of(word(0, angles - 1, 2))[1], -largest, 1e-9);
    EXPECT_GT(largest, 7.5);
}

// The smallest radius as well: no deviate is zero.
TEST(BoxMuller, TheFourQuadrantsMirrorEachOther) {
    std::mt19937_64 random{2};
    for (int trial = 0; trial < 1000; ++trial) {
        const std::uint64_t k = trial == 0 ? radii - 1 : random() % radii, j = random() % angles;
        const auto [x, y] = pair_of(word(k, j, 0));
        EXPECT_GT(x, 0.0);
        EXPECT_GT(y, 0.0);
        EXPECT_EQ(pair_of(word(k, j, 1)), (std::array{-x, y}));
        EXPECT_EQ(pair_of(word(k, j, 2)), (std::array{x, -y}));
        EXPECT_EQ(pair_of(word(k, j, 3)), (std::array{-x, -y}));
    }
}

}  // namespace zlg::chance::box_muller_test
