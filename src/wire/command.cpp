#include <zlg/wire/command.hpp>

#include "packing.hpp"

namespace zlg::wire {
namespace {

constexpr std::size_t command_head_bytes = 2;
constexpr std::size_t piece_head_bytes = 4;
constexpr std::size_t reply_head_bytes = 13;
constexpr std::size_t parameter_bytes = 10;

void pack(Packer& p, const Parameters& parameters) noexcept {
    p(parameters.n);
    for (std::size_t k = 0; k < parameters.n && k < max_parameters; ++k)
        p(parameters.items[k].key, parameters.items[k].value);
}

// In a body of the length that their number asks for.
bool unpack(Unpacker& u, std::size_t left_bytes, Parameters& parameters) noexcept {
    u(parameters.n);
    if (parameters.n > max_parameters || left_bytes != parameters.n * parameter_bytes) return false;
    for (std::size_t k = 0; k < parameters.n; ++k) u(parameters.items[k].key, parameters.items[k].value);
    return true;
}

// The numbers before the parameters in their order.
template <class Codec, class AnyReply>
void lay_out(Codec& codec, AnyReply& r) noexcept {
    codec(r.session, r.sequence, r.code, r.result, r.key, r.part, r.fault);
}

}  // namespace

Frame frame_of(Sender& sender, const Command& command) noexcept {
    Packer p;
    p(command.code);
    pack(p, command.parameters);
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
    lay_out(p, reply);
    pack(p, reply.parameters);
    return frame_of(sender, MessageType::reply, p.body());
}

std::optional<Command> command_in(const Message& message) noexcept {
    if (message.type != MessageType::command || message.body.size() < command_head_bytes) return std::nullopt;
    Unpacker u{message.body};
    Command command;
    u(command.code);
    if (command.code < CommandCode::read_state || command.code > CommandCode::set_parameters) return std::nullopt;
    if (!unpack(u, message.body.size() - command_head_bytes, command.parameters)) return std::nullopt;
    return command;
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
    if (message.type != MessageType::reply || message.body.size() < reply_head_bytes) return std::nullopt;
    Unpacker u{message.body};
    Reply reply;
    lay_out(u, reply);
    if (reply.result > CommandResult::switch_under_way || reply.part > RefusingPart::compensation) return std::nullopt;
    if (!unpack(u, message.body.size() - reply_head_bytes, reply.parameters)) return std::nullopt;
    return reply;
}

}  // namespace zlg::wire
