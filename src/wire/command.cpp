#include <zlg/wire/command.hpp>

#include "packing.hpp"

namespace zlg::wire {
namespace {

constexpr std::size_t command_bytes = 2;
constexpr std::size_t piece_head_bytes = 4;
constexpr std::size_t reply_bytes = 13;

// The numbers in their order; where a former version had parameters stand zeros.
template <class Codec, class AnyReply>
void lay_out(Codec& codec, AnyReply& r, std::uint16_t& key, std::uint8_t& n) noexcept {
    codec(r.session, r.sequence, r.code, r.result, key, r.part, r.fault, n);
}

}  // namespace

Frame frame_of(Sender& sender, CommandCode command) noexcept {
    Packer p;
    p(command, std::uint8_t{0});
    return frame_of(sender, MessageType::command, p.body());
}

Frame frame_of(Sender& sender, const SettingsPiece& piece) noexcept {
    Packer p;
    p(CommandCode::load, static_cast<std::uint8_t>(piece.bytes.size()), piece.offset);
    for (const std::uint8_t byte : piece.bytes) p(byte);
    return frame_of(sender, MessageType::command, p.body());
}

Frame frame_of(Sender& sender, const Reply& reply) noexcept {
    Packer p;
    std::uint16_t key = 0;
    std::uint8_t n = 0;
    lay_out(p, reply, key, n);
    return frame_of(sender, MessageType::reply, p.body());
}

std::optional<CommandCode> command_in(const Message& message) noexcept {
    if (piece_in(message)) return CommandCode::load;
    if (message.type != MessageType::command || message.body.size() != command_bytes) return std::nullopt;
    const CommandCode code{message.body[0]};
    if (code < CommandCode::read_state || code > CommandCode::force_switch || message.body[1] != 0) return std::nullopt;
    return code;
}

std::optional<SettingsPiece> piece_in(const Message& message) noexcept {
    if (message.type != MessageType::command || message.body.size() < piece_head_bytes) return std::nullopt;
    Unpacker u{message.body};
    CommandCode code{};
    std::uint8_t n = 0;
    SettingsPiece piece{.bytes = message.body.subspan(piece_head_bytes)};
    u(code, n, piece.offset);
    if (code != CommandCode::load || n > max_piece_bytes || n != piece.bytes.size()) return std::nullopt;
    return piece;
}

std::optional<Reply> reply_in(const Message& message) noexcept {
    if (message.type != MessageType::reply || message.body.size() != reply_bytes) return std::nullopt;
    Unpacker u{message.body};
    Reply reply;
    std::uint16_t key = 0;
    std::uint8_t n = 0;
    lay_out(u, reply, key, n);
    if (reply.result > CommandResult::switch_under_way || reply.part > RefusingPart::compensation) return std::nullopt;
    return reply;
}

}  // namespace zlg::wire
