// The generator against its authors: known answers of their paper's software, and their own code, which Debian
// packages.

#include "philox.hpp"
#include "test.hpp"

#include <Random123/philox.h>

namespace zlg::chance::philox_test {

struct KnownAnswer {
    Counter counter;
    std::uint64_t key;
    Counter words;
};

Counter words_of(const Block& block) {
    return {static_cast<std::uint32_t>(block[0]), static_cast<std::uint32_t>(block[0] >> 32),
            static_cast<std::uint32_t>(block[1]), static_cast<std::uint32_t>(block[1] >> 32)};
}

// The lines "philox4x32 10" of the file kat_vectors of Random123: zeros, ones, digits of pi.
TEST(Philox, GivesTheKnownAnswersOfItsAuthors) {
    constexpr std::uint32_t f = 0xffffffffu;
    const KnownAnswer answers[]{
        {{0, 0, 0, 0}, 0, {0x6627e8d5u, 0xe169c58du, 0xbc57ac4cu, 0x9b00dbd8u}},
        {{f, f, f, f}, 0xffffffffffffffffu, {0x408f276du, 0x41c83b0eu, 0xa20bc7c6u, 0x6d5451fdu}},
        {{0x243f6a88u, 0x85a308d3u, 0x13198a2eu, 0x03707344u},
         0x299f31d0a4093822u,
         {0xd16cfe09u, 0x94fdcceb, 0x5001e420u, 0x24126ea1u}}};
    for (const KnownAnswer& a : answers) EXPECT_EQ(words_of(philox(a.counter, a.key)), a.words);
}

TEST(Philox, IsThatOfRandom123OnRandomCountersAndKeys) {
    std::mt19937 random{1};
    for (int trial = 0; trial < 10'000; ++trial) {
        const Counter counter{static_cast<std::uint32_t>(random()), static_cast<std::uint32_t>(random()),
                              static_cast<std::uint32_t>(random()), static_cast<std::uint32_t>(random())};
        const r123::Philox4x32::key_type key{
            {static_cast<std::uint32_t>(random()), static_cast<std::uint32_t>(random())}};
        const auto theirs =
            r123::Philox4x32{}(r123::Philox4x32::ctr_type{{counter[0], counter[1], counter[2], counter[3]}}, key);
        const Counter expected{theirs[0], theirs[1], theirs[2], theirs[3]};
        ASSERT_EQ(words_of(philox(counter, std::uint64_t{key[1]} << 32 | key[0])), expected);
    }
}

// Eleven: two times four at once, and three alone; over the end of the first word.
TEST(Philox, ManyBlocksAtOnceAreThoseTakenOneByOne) {
    std::mt19937_64 random{2};
    for (int trial = 0; trial < 1000; ++trial) {
        const Counter counter{0xfffffff0u + static_cast<std::uint32_t>(random() % 16),
                              static_cast<std::uint32_t>(random()), static_cast<std::uint32_t>(random()),
                              static_cast<std::uint32_t>(random())};
        const std::uint64_t key = random();
        const auto words = philox_blocks<11>(counter, key);
        for (std::uint32_t i = 0; i < 11; ++i) {
            const Block one = philox({counter[0] + i, counter[1], counter[2], counter[3]}, key);
            ASSERT_EQ(words[2 * i], one[0]);
            ASSERT_EQ(words[2 * i + 1], one[1]);
        }
    }
}

}  // namespace zlg::chance::philox_test
