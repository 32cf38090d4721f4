#pragma once
// What a command does to the gyro: the decision, without the doing.

#include <optional>

#include <zlg/wire/command.hpp>

namespace zlg::wire {

struct CommandState {
    std::optional<Reply> last{};  // to the last command that was obeyed or refused since the start
};

struct CommandOutput {
    bool has_reply = false;  // false: the message was no command
    Reply reply{};
    // What the caller has to do, at a border of a tick and with the interrupt of the half-period kept away; nothing for
    // a command that was obeyed before. What came of `load` it puts into the reply and into `last`.
    std::optional<CommandCode> due{};
};

// Answer one message.
//
// cost   no allocation. For the background, not for the interrupt.
[[nodiscard]] CommandOutput handle(CommandState& state, const Message& message) noexcept;

}  // namespace zlg::wire
