#pragma once
// Commands to the gyro and its replies.
//
// The session and sequence number of a command's frame are its identity. A host that gets no reply sends the same frame
// again; the gyro answers a command that it has just obeyed with the same reply and does not obey it twice.

#include <array>
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
    force_switch = 4,     // at the next tick border at which the gyro is ready, also while switching is stopped
    read_parameters = 5,  // of the keys given
    set_parameters = 6,   // all of the keys given, or none of them
    load = 7,             // a piece of stored settings (SettingsPiece)
};

inline constexpr std::size_t max_parameters = 16;

struct Parameter {
    std::uint16_t key = 0;
    double value = 0.0;  // integers and choices too; not used where a parameter is read

    friend bool operator==(const Parameter&, const Parameter&) = default;
};

struct Parameters {
    std::array<Parameter, max_parameters> items{};
    std::uint8_t n = 0;

    friend bool operator==(const Parameters&, const Parameters&) = default;
};

struct Command {
    CommandCode code = CommandCode::read_state;
    Parameters parameters{};

    friend bool operator==(const Command&, const Command&) = default;
};

// Of code `load`: some bytes of settings as they are stored, or none, which ends them.
struct SettingsPiece {
    std::uint16_t offset = 0;               // of the first byte; of the piece without any: how many there are
    std::span<const std::uint8_t> bytes{};  // up to max_piece_bytes; good as long as the message that it came in
};

inline constexpr std::size_t max_piece_bytes = 224;

enum class CommandResult : std::uint8_t {
    done = 0,
    malformed = 1,    // no command of a known code and the right length
    unknown_key = 2,  // `key`
    read_only = 3,    // `key` can be changed only where the image is built
    not_a_value = 4,  // of `key`: not finite, or no whole number where one is needed
    not_allowed =
        5,        // the core refuses; `key` alone, or 0 where only several together do. `part` and `fault` say where
    damaged = 6,  // the pieces are no whole settings
    other_program = 7,     // they are of sources of another version
    switch_under_way = 8,  // nothing is loaded meanwhile
};

enum class RefusingPart : std::uint8_t { none = 0, control = 1, compensation = 2 };

struct Reply {
    std::uint16_t session = 0;  // of the command
    std::uint32_t sequence = 0;
    std::uint8_t code = 0;
    CommandResult result = CommandResult::done;
    std::uint16_t key = 0;  // at fault
    RefusingPart part = RefusingPart::none;
    std::uint8_t fault = 0;   // core::GyroControlFault or core::GyroCompensationFault of the refusing part
    Parameters parameters{};  // as they are now

    friend bool operator==(const Reply&, const Reply&) = default;
};

[[nodiscard]] Frame frame_of(Sender& sender, const Command& command) noexcept;
[[nodiscard]] Frame frame_of(Sender& sender, const SettingsPiece& piece) noexcept;
[[nodiscard]] Frame frame_of(Sender& sender, const Reply& reply) noexcept;

// Nothing where the message is of another type, length or code.
[[nodiscard]] std::optional<Command> command_in(const Message& message) noexcept;
[[nodiscard]] std::optional<SettingsPiece> piece_in(const Message& message) noexcept;
[[nodiscard]] std::optional<Reply> reply_in(const Message& message) noexcept;

}  // namespace zlg::wire
