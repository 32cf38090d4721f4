#include <zlg/wire/command.hpp>

#include "packing.hpp"
#include "unpacking.hpp"

namespace zlg::wire {
namespace {

constexpr std::size_t command_head_bytes = 2;
constexpr std::size_t reply_head_bytes = 13;
constexpr std::size_t parameter_bytes = 10;

void pack(Packer& p, const Parameters& parameters) noexcept {
    p.u8(parameters.n);
    for (std::size_t k = 0; k < parameters.n && k < max_parameters; ++k) {
        p.u16(parameters.items[k].key);
        p.f64(parameters.items[k].value);
    }
}

// In a body of the length that their number asks for.
bool unpack(Unpacker& u, std::size_t left_bytes, Parameters& parameters) noexcept {
    parameters.n = u.u8();
    if (parameters.n > max_parameters || left_bytes != parameters.n * parameter_bytes) return false;
    for (std::size_t k = 0; k < parameters.n; ++k) {
        parameters.items[k].key = u.u16();
        parameters.items[k].value = u.f64();
    }
    return true;
}

}  // namespace

Frame frame_of(Sender& sender, const Command& command) noexcept {
    Packer p;
    p.u8(static_cast<std::uint8_t>(command.code));
    pack(p, command.parameters);
    return frame_of(sender, MessageType::command, p.body());
}

Frame frame_of(Sender& sender, const Reply& reply) noexcept {
    Packer p;
    p.u16(reply.session);
    p.u32(reply.sequence);
    p.u8(reply.code);
    p.u8(static_cast<std::uint8_t>(reply.result));
    p.u16(reply.key);
    p.u8(static_cast<std::uint8_t>(reply.part));
    p.u8(reply.fault);
    pack(p, reply.parameters);
    return frame_of(sender, MessageType::reply, p.body());
}

std::optional<Command> command_in(const Message& message) noexcept {
    if (message.type != MessageType::command || message.body.size() < command_head_bytes) return std::nullopt;
    Unpacker u{message.body};
    Command command;
    command.code = static_cast<CommandCode>(u.u8());
    if (command.code < CommandCode::read_state || command.code > CommandCode::set_parameters) return std::nullopt;
    if (!unpack(u, message.body.size() - command_head_bytes, command.parameters)) return std::nullopt;
    return command;
}

std::optional<Reply> reply_in(const Message& message) noexcept {
    if (message.type != MessageType::reply || message.body.size() < reply_head_bytes) return std::nullopt;
    Unpacker u{message.body};
    Reply reply;
    reply.session = u.u16();
    reply.sequence = u.u32();
    reply.code = u.u8();
    reply.result = static_cast<CommandResult>(u.u8());
    reply.key = u.u16();
    reply.part = static_cast<RefusingPart>(u.u8());
    reply.fault = u.u8();
    if (reply.result > CommandResult::not_allowed || reply.part > RefusingPart::compensation) return std::nullopt;
    if (!unpack(u, message.body.size() - reply_head_bytes, reply.parameters)) return std::nullopt;
    return reply;
}

}  // namespace zlg::wire
