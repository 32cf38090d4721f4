#include <zlg/wire/crc.hpp>

#include "test.hpp"

namespace zlg::wire::crc_test {

std::vector<std::uint8_t> run(std::size_t n, int from, int step) {
    std::vector<std::uint8_t> bytes;
    for (std::size_t k = 0; k < n; ++k) bytes.push_back(static_cast<std::uint8_t>(from + step * static_cast<int>(k)));
    return bytes;
}

// By the definition: division of the message by the polynomial, bit by bit, the lowest bit of each byte first.
std::uint32_t divided(const std::vector<std::uint8_t>& bytes) {
    std::uint32_t remainder = 0xFFFFFFFF;
    for (const std::uint8_t byte : bytes) {
        for (int bit = 0; bit < 8; ++bit) {
            const bool out = ((remainder >> 31) ^ (static_cast<std::uint32_t>(byte) >> bit)) & 1;
            remainder = (remainder << 1) ^ (out ? 0x1EDC6F41u : 0u);
        }
    }
    std::uint32_t reversed = 0;
    for (int bit = 0; bit < 32; ++bit) reversed |= ((remainder >> bit) & 1) << (31 - bit);
    return ~reversed;
}

TEST(Crc32c, HasThePublishedCheckValue) {
    const std::array<std::uint8_t, 9> digits{'1', '2', '3', '4', '5', '6', '7', '8', '9'};
    EXPECT_EQ(crc32c(digits), 0xE3069283u);
}

// RFC 3720, B.4.
TEST(Crc32c, HasTheValuesOfTheStandardOfIscsi) {
    EXPECT_EQ(crc32c(std::vector<std::uint8_t>(32, 0x00)), 0x8A9136AAu);
    EXPECT_EQ(crc32c(std::vector<std::uint8_t>(32, 0xFF)), 0x62A8AB43u);
    EXPECT_EQ(crc32c(run(32, 0, 1)), 0x46DD794Eu);
    EXPECT_EQ(crc32c(run(32, 31, -1)), 0x113FDB5Cu);
}

TEST(Crc32c, IsTheRemainderByDefinition) {
    for (std::size_t n = 0; n < 200; n += 7) EXPECT_EQ(crc32c(run(n, 3, 37)), divided(run(n, 3, 37))) << n;
}

TEST(Crc32c, SeesEveryErrorOfOneOrTwoBitsInAMessageOfTelemetry) {
    auto bytes = run(116, 1, 91);
    const std::uint32_t good = crc32c(bytes);
    const auto flip = [&bytes](std::size_t bit) {
        bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] ^ (1u << (bit % 8)));
    };
    for (std::size_t a = 0; a < 8 * bytes.size(); ++a) {
        flip(a);
        ASSERT_NE(crc32c(bytes), good) << a;
        // The CRC is linear: what two bits do depends on their distance alone.
        const std::size_t b = 8 * bytes.size() - 1;
        if (b != a) {
            flip(b);
            ASSERT_NE(crc32c(bytes), good) << a;
            flip(b);
        }
        flip(a);
    }
}

}  // namespace zlg::wire::crc_test
