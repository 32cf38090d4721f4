#include <zlg/wire/command_handler.hpp>

namespace zlg::wire {

CommandOutput handle(CommandState& state, const Message& message) noexcept {
    if (message.type != MessageType::command) return {};
    CommandOutput out{.has_reply = true};
    if (state.last && state.last->session == message.session && state.last->sequence == message.sequence) {
        out.reply = *state.last;
        // The state may be asked for again: telling it does nothing.
        if (out.reply == Reply{message.session, message.sequence, static_cast<std::uint8_t>(CommandCode::read_state)})
            out.due = CommandCode::read_state;
        return out;
    }
    out.due = command_in(message);
    out.reply = {.session = message.session,
                 .sequence = message.sequence,
                 .code = message.body.empty() ? std::uint8_t{0} : message.body.front(),
                 .result = out.due ? CommandResult::done : CommandResult::malformed};
    state.last = out.reply;
    return out;
}

}  // namespace zlg::wire
