#pragma once
// What a command does to the gyro: the decision, without the doing.

#include <zlg/wire/command.hpp>
#include <zlg/wire/parameters.hpp>

namespace zlg::wire {

struct CommandState {
    GyroSettings settings{};  // checked; the background's copy of what the gyro runs by
    bool has_last = false;    // a command was obeyed or refused since the start:
    Reply last{};             // the answer to it
};

// What the caller has to do, each at a border of a tick and with the interrupt of the half-period kept away.
struct CommandEffect {
    bool settings_changed = false;  // copy `settings` to where the interrupt reads them, and to the memory that stays
    bool stop_switching = false;    // held = true in the state of the schedule
    bool start_switching = false;   // held = false
    bool force_switch = false;      // asked = true
    bool send_status = false;       // now, after the reply
    bool load = false;  // take the piece in the message, and put what came of it into the reply and into `last`

    friend bool operator==(const CommandEffect&, const CommandEffect&) = default;
};

struct CommandOutput {
    bool has_reply = false;  // false: the message was no command
    Reply reply{};
    CommandEffect effect{};  // nothing for a command that was obeyed before
};

// Answer one message.
//
// Parameters are stored all or none: only where the core's `check` of control and of compensation passes with all of
// them.
//
// state  settings that passed `check` of both parts; they do so afterwards.
// cost   up to 17 checks of the core's configuration; no allocation. For the background, not for the interrupt.
[[nodiscard]] CommandOutput handle(CommandState& state, const Message& message) noexcept;

}  // namespace zlg::wire
