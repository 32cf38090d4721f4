#include <zlg/wire/command.hpp>

#include "carried.hpp"

namespace zlg::wire::command_test {

Parameters full() {
    Parameters p{.n = max_parameters};
    for (std::size_t k = 0; k < max_parameters; ++k)
        p.items[k] = {static_cast<std::uint16_t>(0x0101 + k), 1.5 * static_cast<double>(k)};
    return p;
}

TEST(Command, ArrivesAsItWasSent) {
    const Command command{.code = CommandCode::set_parameters, .parameters = full()};
    EXPECT_EQ(command_in({.type = MessageType::command, .body = body_of(command)}), command);
    const Command empty{.code = CommandCode::force_switch};
    EXPECT_EQ(command_in({.type = MessageType::command, .body = body_of(empty)}), empty);
}

TEST(Command, HasTheLayoutOfTheDescription) {
    const Command command{.code = CommandCode::set_parameters, .parameters = {.items = {{{0x0402, 1.0}}}, .n = 1}};
    EXPECT_EQ(body_of(command), (std::vector<std::uint8_t>{6, 1, 0x02, 0x04, 0, 0, 0, 0, 0, 0, 0xF0, 0x3F}));
}

TEST(Command, OfUnknownCodeOrOtherLengthIsRefused) {
    const auto body = body_of(Command{.code = CommandCode::read_parameters, .parameters = full()});
    const auto refused = [](std::vector<std::uint8_t> bytes) {
        return !command_in({.type = MessageType::command, .body = bytes}).has_value();
    };
    EXPECT_FALSE(refused(body));
    auto bad = body;
    bad[0] = 0;
    EXPECT_TRUE(refused(bad));
    bad[0] = 7;
    EXPECT_TRUE(refused(bad));
    bad = body;
    bad[1] = 15;
    EXPECT_TRUE(refused(bad));
    bad[1] = 17;
    bad.resize(2 + 170);
    EXPECT_TRUE(refused(bad));
    EXPECT_TRUE(refused({}));
    EXPECT_TRUE(refused({1}));
    EXPECT_FALSE(command_in({.type = MessageType::reply, .body = body}).has_value());
}

TEST(SettingsPiece, ArrivesAsItWasSent) {
    std::vector<std::uint8_t> bytes(max_piece_bytes);
    for (std::size_t k = 0; k < bytes.size(); ++k) bytes[k] = static_cast<std::uint8_t>(k);
    for (const std::size_t n : {std::size_t{0}, std::size_t{1}, max_piece_bytes}) {
        const auto body = body_of(SettingsPiece{.offset = 0x1234, .bytes = std::span{bytes}.first(n)});
        EXPECT_EQ(std::vector(body.begin(), body.begin() + 4),
                  (std::vector<std::uint8_t>{7, static_cast<std::uint8_t>(n), 0x34, 0x12}));
        const auto piece = piece_in({.type = MessageType::command, .body = body});
        ASSERT_TRUE(piece);
        EXPECT_EQ(piece->offset, 0x1234);
        EXPECT_TRUE(std::ranges::equal(piece->bytes, std::span{bytes}.first(n)));
    }
}

TEST(SettingsPiece, OfOtherCodeOrLengthIsRefused) {
    const std::vector<std::uint8_t> bytes(10);
    const auto body = body_of(SettingsPiece{.bytes = bytes});
    const auto is_taken = [](std::vector<std::uint8_t> changed) {
        return piece_in({.type = MessageType::command, .body = changed}).has_value();
    };
    EXPECT_TRUE(is_taken(body));
    EXPECT_FALSE(is_taken({body.begin(), body.end() - 1}));
    EXPECT_FALSE(is_taken({7, 0, 0}));
    EXPECT_FALSE(is_taken({6, 0, 0, 0}));
    EXPECT_FALSE(piece_in({.type = MessageType::reply, .body = body}).has_value());
}

TEST(Reply, ArrivesAsItWasSent) {
    const Reply reply{.session = 0x1234,
                      .sequence = 0x89ABCDEF,
                      .code = 6,
                      .result = CommandResult::not_allowed,
                      .key = 0x0402,
                      .part = RefusingPart::control,
                      .fault = 6,
                      .parameters = full()};
    EXPECT_EQ(reply_in({.type = MessageType::reply, .body = body_of(reply)}), reply);
}

TEST(Reply, HasTheLayoutOfTheDescription) {
    const Reply reply{.session = 0x1234,
                      .sequence = 0x89ABCDEF,
                      .code = 6,
                      .result = CommandResult::not_allowed,
                      .key = 0x0402,
                      .part = RefusingPart::compensation,
                      .fault = 7};
    EXPECT_EQ(body_of(reply),
              (std::vector<std::uint8_t>{0x34, 0x12, 0xEF, 0xCD, 0xAB, 0x89, 6, 5, 0x02, 0x04, 2, 7, 0}));
}

TEST(Reply, WhatNoGyroSendsIsRefused) {
    auto body = body_of(Reply{});
    EXPECT_TRUE(reply_in({.type = MessageType::reply, .body = body}).has_value());
    body[7] = 9;
    EXPECT_FALSE(reply_in({.type = MessageType::reply, .body = body}).has_value());
    body[7] = 0;
    body[10] = 3;
    EXPECT_FALSE(reply_in({.type = MessageType::reply, .body = body}).has_value());
    body[10] = 0;
    body.pop_back();
    EXPECT_FALSE(reply_in({.type = MessageType::reply, .body = body}).has_value());
}

}  // namespace zlg::wire::command_test
