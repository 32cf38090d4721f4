#pragma once
// Commands to the gyro and its replies.
//
// The session and sequence number of a command's frame are its identity. A host that gets no reply sends the same frame
// again; the gyro answers a command that it has just obeyed with the same reply and does not obey it twice.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include <zlg/wire/frame.hpp>

namespace zlg::wire {

enum class CommandCode : std::uint8_t {
    read_state = 1,      // the status message follows the reply
    stop_switching = 2,  // no scheduled switch until `start_switching`
    start_switching = 3,
    force_switch = 4,  // at the next tick border at which the gyro is ready, also while switching is stopped
    load = 7,          // a piece of stored settings (SettingsPiece)
};

// Of code `load`: some bytes of settings as they are stored, or none, which ends them.
struct SettingsPiece {
    std::uint16_t offset = 0;               // of the first byte; of the piece without any: how many there are
    std::span<const std::uint8_t> bytes{};  // up to max_piece_bytes; good as long as the message that it came in
};

inline constexpr std::size_t max_piece_bytes = 224;

enum class CommandResult : std::uint8_t {
    done = 0,
    malformed = 1,         // no command of a known code and the right length
    not_allowed = 5,       // the core refuses; `part` and `fault` say where
    damaged = 6,           // the pieces are no whole settings
    other_program = 7,     // they are of sources of another version
    switch_under_way = 8,  // nothing is loaded meanwhile
};

enum class RefusingPart : std::uint8_t { none = 0, control = 1, compensation = 2 };

struct Reply {
    std::uint16_t session = 0;  // of the command
    std::uint32_t sequence = 0;
    std::uint8_t code = 0;
    CommandResult result = CommandResult::done;
    RefusingPart part = RefusingPart::none;
    std::uint8_t fault = 0;  // core::GyroControlFault or core::GyroCompensationFault of the refusing part

    friend bool operator==(const Reply&, const Reply&) = default;
};

// Of a code that stands alone: any but `load`.
[[nodiscard]] Frame frame_of(Sender& sender, CommandCode command) noexcept;
[[nodiscard]] Frame frame_of(Sender& sender, const SettingsPiece& piece) noexcept;
[[nodiscard]] Frame frame_of(Sender& sender, const Reply& reply) noexcept;

// Nothing where the message is of another type, length or code.
[[nodiscard]] std::optional<CommandCode> command_in(const Message& message) noexcept;
[[nodiscard]] std::optional<SettingsPiece> piece_in(const Message& message) noexcept;
[[nodiscard]] std::optional<Reply> reply_in(const Message& message) noexcept;

}  // namespace zlg::wire
