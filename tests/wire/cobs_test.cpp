#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <zlg/wire/frame.hpp>

#include "test.hpp"

namespace zlg::wire::cobs_test {

using Bytes = std::vector<std::uint8_t>;

Bytes stuffed(const Bytes& bytes) {
    Bytes out(stuffed_bytes(bytes.size()));
    out.resize(stuff(bytes, out));
    return out;
}

Bytes count(int from, int to) {
    Bytes bytes;
    for (int k = from; k <= to; ++k) bytes.push_back(static_cast<std::uint8_t>(k));
    return bytes;
}

Bytes joined(Bytes a, const Bytes& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

// The examples of the encoding's published description.
TEST(Cobs, HasThePublishedExamples) {
    EXPECT_EQ(stuffed({0x00}), (Bytes{0x01, 0x01}));
    EXPECT_EQ(stuffed({0x00, 0x00}), (Bytes{0x01, 0x01, 0x01}));
    EXPECT_EQ(stuffed({0x00, 0x11, 0x00}), (Bytes{0x01, 0x02, 0x11, 0x01}));
    EXPECT_EQ(stuffed({0x11, 0x22, 0x00, 0x33}), (Bytes{0x03, 0x11, 0x22, 0x02, 0x33}));
    EXPECT_EQ(stuffed({0x11, 0x22, 0x33, 0x44}), (Bytes{0x05, 0x11, 0x22, 0x33, 0x44}));
    EXPECT_EQ(stuffed({0x11, 0x00, 0x00, 0x00}), (Bytes{0x02, 0x11, 0x01, 0x01, 0x01}));
    EXPECT_EQ(stuffed(count(1, 254)), joined({0xFF}, count(1, 254)));
    EXPECT_EQ(stuffed(count(0, 254)), joined({0x01, 0xFF}, count(1, 254)));
    EXPECT_EQ(stuffed(count(1, 255)), joined(joined({0xFF}, count(1, 254)), {0x02, 0xFF}));
    EXPECT_EQ(stuffed(joined(count(2, 255), {0x00})), joined(joined({0xFF}, count(2, 255)), {0x01, 0x01}));
    EXPECT_EQ(stuffed(joined(count(3, 255), {0x00, 0x01})), joined(joined({0xFE}, count(3, 255)), {0x02, 0x01}));
}

TEST(Cobs, ABlockThatReachesBeyondTheEndIsRefused) {
    Bytes bytes{0x05, 0x11, 0x22, 0x33};
    EXPECT_FALSE(unstuff(bytes).good);
    bytes = {0x02, 0x11, 0x03, 0x22};
    EXPECT_FALSE(unstuff(bytes).good);
}

TEST(Cobs, AZeroInsideIsRefused) {
    Bytes bytes{0x03, 0x11, 0x00};
    EXPECT_FALSE(unstuff(bytes).good);
    bytes = {0x02, 0x11, 0x00, 0x22};
    EXPECT_FALSE(unstuff(bytes).good);
}

TEST(Cobs, NothingIsNoMessage) {
    Bytes none;
    EXPECT_FALSE(unstuff(none).good);
}

RC_GTEST_PROP(Cobs, ComesBackAndHoldsNoZero, ()) {
    // Runs without a zero, up to the length at which blocks break.
    const auto n = *rc::gen::inRange<std::size_t>(1, 600);
    const auto bytes = *rc::gen::container<Bytes>(
        n, rc::gen::weightedOneOf<std::uint8_t>(
               {{1, rc::gen::just<std::uint8_t>(0)}, {300, rc::gen::inRange<std::uint8_t>(1, 255)}}));
    Bytes out = stuffed(bytes);
    RC_ASSERT(out.size() <= stuffed_bytes(bytes.size()));
    RC_ASSERT(std::count(out.begin(), out.end(), std::uint8_t{0}) == 0);
    const Unstuffed back = unstuff(out);
    RC_ASSERT(back.good);
    out.resize(back.size);
    RC_ASSERT(out == bytes);
}

}  // namespace zlg::wire::cobs_test
