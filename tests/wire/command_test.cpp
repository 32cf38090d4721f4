#include <zlg/wire/command.hpp>

#include "carried.hpp"

namespace zlg::wire::command_test {

constexpr std::array commands{CommandCode::read_state, CommandCode::stop_switching, CommandCode::start_switching,
                              CommandCode::force_switch};

TEST(Command, ArrivesAsItWasSent) {
    for (const CommandCode code : commands)
        EXPECT_EQ(command_in({.type = MessageType::command, .body = body_of(code)}), code);
    EXPECT_EQ(command_in({.type = MessageType::command, .body = body_of(SettingsPiece{})}), CommandCode::load);
}

TEST(Command, HasTheLayoutOfTheDescription) {
    EXPECT_EQ(body_of(CommandCode::force_switch), (std::vector<std::uint8_t>{4, 0}));
}

TEST(Command, OfUnknownCodeOrOtherLengthIsRefused) {
    const auto refused = [](std::vector<std::uint8_t> bytes) {
        return !command_in({.type = MessageType::command, .body = bytes}).has_value();
    };
    EXPECT_FALSE(refused({1, 0}));
    for (const auto code : std::to_array<std::uint8_t>({0, 5, 6, 7, 8, 255}))
        EXPECT_TRUE(refused({code, 0})) << int{code};
    EXPECT_TRUE(refused({1, 1}));
    EXPECT_TRUE(refused({1, 0, 0}));
    EXPECT_TRUE(refused({6, 1, 0x02, 0x04, 0, 0, 0, 0, 0, 0, 0xF0, 0x3F})) << "of a former version";
    EXPECT_TRUE(refused({}));
    EXPECT_TRUE(refused({1}));
    EXPECT_FALSE(command_in({.type = MessageType::reply, .body = body_of(commands[0])}).has_value());
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
                      .code = 7,
                      .result = CommandResult::not_allowed,
                      .part = RefusingPart::control,
                      .fault = 6};
    EXPECT_EQ(reply_in({.type = MessageType::reply, .body = body_of(reply)}), reply);
}

TEST(Reply, HasTheLayoutOfTheDescription) {
    const Reply reply{.session = 0x1234,
                      .sequence = 0x89ABCDEF,
                      .code = 7,
                      .result = CommandResult::not_allowed,
                      .part = RefusingPart::compensation,
                      .fault = 7};
    EXPECT_EQ(body_of(reply), (std::vector<std::uint8_t>{0x34, 0x12, 0xEF, 0xCD, 0xAB, 0x89, 7, 5, 0, 0, 2, 7, 0}));
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
