#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <zlg/wire/crc.hpp>
#include <zlg/wire/frame.hpp>

#include "test.hpp"

namespace zlg::wire::frame_test {

using Bytes = std::vector<std::uint8_t>;

struct Got {
    MessageType type;
    std::uint16_t session;
    std::uint32_t sequence;
    Bytes body;

    friend bool operator==(const Got&, const Got&) = default;
};

std::vector<Got> received(Receiver& receiver, const Bytes& bytes) {
    std::vector<Got> all;
    std::span<const std::uint8_t> left{bytes};
    Message m;
    while (receive(receiver, left, m))
        all.push_back({m.type, m.session, m.sequence, Bytes{m.body.begin(), m.body.end()}});
    return all;
}

std::vector<Got> received(const Bytes& bytes) {
    Receiver receiver;
    return received(receiver, bytes);
}

Bytes framed(Sender& sender, const Bytes& body, MessageType type = MessageType::telemetry) {
    const Frame frame = frame_of(sender, type, body);
    return {frame.view().begin(), frame.view().end()};
}

Bytes operator+(Bytes a, const Bytes& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

// By hand from the description: 01 version, 02 type, 0305 session, 00000007 sequence, body AA 00, CRC of all that.
TEST(Frame, HasTheBytesOfTheDescription) {
    const Bytes message{0x01, 0x02, 0x05, 0x03, 0x07, 0x00, 0x00, 0x00, 0xAA, 0x00};
    const std::uint32_t crc = crc32c(message);
    ASSERT_NE(crc & 0xFF, 0u);
    ASSERT_NE((crc >> 8) & 0xFF, 0u);
    ASSERT_NE((crc >> 16) & 0xFF, 0u);
    ASSERT_NE(crc >> 24, 0u);
    const auto byte = [crc](int k) { return static_cast<std::uint8_t>(crc >> (8 * k)); };
    Sender sender{.session = 0x0305, .sequence = 7};
    EXPECT_EQ(framed(sender, {0xAA, 0x00}, MessageType::status),
              (Bytes{0x00, 0x06, 0x01, 0x02, 0x05, 0x03, 0x07, 0x01, 0x01, 0x02, 0xAA, 0x05, byte(0), byte(1), byte(2),
                     byte(3), 0x00}));
    EXPECT_EQ(sender.sequence, 8u);
}

TEST(Frame, TheNumberWraps) {
    Sender sender{.session = 1, .sequence = 0xFFFFFFFF};
    const Bytes first = framed(sender, {1});
    const auto got = received(first + framed(sender, {2}));
    ASSERT_EQ(got.size(), 2u);
    EXPECT_EQ(got[0].sequence, 0xFFFFFFFFu);
    EXPECT_EQ(got[1].sequence, 0u);
}

TEST(Frame, TheLargestBodyPassesAndALargerOneIsNotSent) {
    Sender sender;
    for (const int value : {0x00, 0x01, 0xFF}) {
        const Bytes body(max_body_bytes, static_cast<std::uint8_t>(value));
        const auto got = received(framed(sender, body));
        ASSERT_EQ(got.size(), 1u);
        EXPECT_EQ(got[0].body, body);
    }
    EXPECT_TRUE(framed(sender, Bytes(max_body_bytes + 1)).empty());
}

TEST(Frame, NoiseInFrontDoesNotSpoilAFrame) {
    Sender sender;
    EXPECT_EQ(received(Bytes(1000, 0x55) + framed(sender, {1, 2, 3})).size(), 1u);
}

TEST(Frame, ALostZeroBetweenTwoFramesCostsNone) {
    Sender sender;
    const Bytes first = framed(sender, {1});
    Bytes second = framed(sender, {2});
    second.erase(second.begin());
    EXPECT_EQ(received(first + second).size(), 2u);
}

TEST(Frame, WhatIsDamagedIsCountedWithItsBytes) {
    Sender sender;
    Bytes bad = framed(sender, {1, 2, 3});
    bad[4] ^= 0x10;
    Receiver receiver;
    EXPECT_TRUE(received(receiver, bad).empty());
    EXPECT_EQ(receiver.n_damaged, 1u);
    EXPECT_EQ(receiver.n_skipped, bad.size() - 2);
    EXPECT_EQ(received(receiver, framed(sender, {4})).size(), 1u);
    EXPECT_EQ(receiver.n_good, 1u);
}

TEST(Frame, MoreBytesWithoutAZeroThanAFrameHasAreSkipped) {
    Receiver receiver;
    EXPECT_TRUE(received(receiver, Bytes(100'000, 0x42) + Bytes{0}).empty());
    EXPECT_EQ(receiver.n_damaged, 1u);
    EXPECT_EQ(receiver.n_skipped, 100'000u);
}

// Stuffed behind its right CRC, whatever it holds.
Bytes sent_with_crc(Bytes message) {
    const std::uint32_t crc = crc32c(message);
    for (int k = 0; k < 4; ++k) message.push_back(static_cast<std::uint8_t>(crc >> (8 * k)));
    Bytes out(stuffed_bytes(message.size()));
    out.resize(stuff(message, out));
    return out + Bytes{0};
}

TEST(Frame, ALargerMessageIsNotTakenHoweverRightItsCrc) {
    for (const std::size_t n_body : {max_body_bytes, max_body_bytes + 1}) {
        const Bytes message(header_bytes + n_body, 0x01);
        EXPECT_EQ(received(sent_with_crc(message)).size(), n_body == max_body_bytes ? 1u : 0u);
    }
}

TEST(Frame, AnotherVersionIsNotTaken) {
    // As `frame_of` makes it, but with version 2 and its right CRC.
    const Bytes message{0x02, 0x01, 0x01, 0x00, 0x01, 0x01, 0x01, 0x01, 0xAA};
    Receiver receiver;
    EXPECT_TRUE(received(receiver, sent_with_crc(message)).empty());
    EXPECT_EQ(receiver.n_foreign, 1u);
}

RC_GTEST_PROP(Frame, TheCutsOfAStreamDoNotMatter, ()) {
    const auto bodies = *rc::gen::container<std::vector<Bytes>>(
        rc::gen::suchThat(rc::gen::arbitrary<Bytes>(), [](const Bytes& b) { return b.size() <= max_body_bytes; }));
    const auto piece = *rc::gen::inRange<std::size_t>(1, 40);
    Sender sender{.session = 9};
    Bytes stream;
    for (const Bytes& body : bodies) stream = stream + framed(sender, body);
    const std::vector<Got> whole = received(stream);
    RC_ASSERT(whole.size() == bodies.size());
    for (std::size_t k = 0; k < bodies.size(); ++k) RC_ASSERT(whole[k].body == bodies[k]);
    Receiver receiver;
    std::vector<Got> in_pieces;
    for (std::size_t from = 0; from < stream.size(); from += piece) {
        const std::size_t to = std::min(stream.size(), from + piece);
        for (Got& got : received(receiver, Bytes(stream.begin() + static_cast<std::ptrdiff_t>(from),
                                                 stream.begin() + static_cast<std::ptrdiff_t>(to))))
            in_pieces.push_back(std::move(got));
    }
    RC_ASSERT(in_pieces == whole);
}

// What arrives has its number: it must be what was sent under it.
struct Line {
    std::mt19937_64 random{1};
    Sender sender{.session = 77};
    std::map<std::uint32_t, Bytes> sent;

    Bytes frames(std::size_t n) {
        Bytes stream;
        for (std::size_t k = 0; k < n; ++k) {
            Bytes body(1 + random() % 120);
            for (std::uint8_t& byte : body) byte = static_cast<std::uint8_t>(random() % 3 == 0 ? 0 : random());
            sent[sender.sequence] = body;
            stream = stream + framed(sender, body);
        }
        return stream;
    }

    std::size_t checked(Receiver& receiver, const Bytes& stream) const {
        const auto all = received(receiver, stream);
        for (const Got& got : all) {
            EXPECT_TRUE(sent.contains(got.sequence)) << got.sequence;
            EXPECT_EQ(got.body, sent.at(got.sequence));
            EXPECT_EQ(got.session, 77u);
        }
        return all.size();
    }
};

TEST(Frame, AfterAnyNoiseTheNextFrameButOneArrives) {
    Line line;
    for (int k = 0; k < 2000; ++k) {
        Receiver receiver;
        Bytes noise(line.random() % 400);
        for (std::uint8_t& byte : noise) byte = static_cast<std::uint8_t>(line.random());
        (void)received(receiver, noise);
        EXPECT_EQ(line.checked(receiver, line.frames(1)), 1u);
    }
}

// 2e5 frames let one pass in 20 000 runs.
TEST(Frame, OfDamagedFramesNonePasses) {
    Line line;
    const Bytes stream = line.frames(200);
    std::size_t n_damaged = 0;
    for (int round = 0; round < 1000; ++round) {
        Bytes bad = stream;
        for (std::size_t from = 0; from < bad.size(); from += 60) {
            const std::size_t at = from + line.random() % 60;
            if (at < bad.size()) bad[at] = static_cast<std::uint8_t>(bad[at] ^ (1u << (line.random() % 8)));
        }
        Receiver receiver;
        (void)line.checked(receiver, bad);
        n_damaged += receiver.n_damaged;
    }
    EXPECT_GT(n_damaged, 100'000u);
}

}  // namespace zlg::wire::frame_test
