#pragma once
// Frames on a line of bytes: who sends what, numbered, and whether it arrived as it was sent.
//
//   00 | stuffed { version 1 | type 1 | session 2 | sequence 4 | body | CRC-32C 4 } | 00
//
// All numbers little-endian. The zero in front costs a byte and saves the frame from noise on a line that was silent.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace zlg::wire {

// Consistent Overhead Byte Stuffing (Cheshire and Baker, 1999): bytes without a zero, so that a zero ends a frame.
//
// A receiver that has lost its place finds it again at the next zero, whatever was before.
//
// What n bytes become at most.
[[nodiscard]] constexpr std::size_t stuffed_bytes(std::size_t n) noexcept { return n + n / 254 + 1; }

// The stuffed bytes, without a zero that ends them.
//
// out     at least stuffed_bytes(bytes.size()); not the same memory.
// return  how many were written.
[[nodiscard]] std::size_t stuff(std::span<const std::uint8_t> bytes, std::span<std::uint8_t> out) noexcept;

struct Unstuffed {
    bool good = false;  // no zero inside, no block that reaches beyond the end
    std::size_t size = 0;
};

// The reverse, in place.
[[nodiscard]] Unstuffed unstuff(std::span<std::uint8_t> bytes) noexcept;

inline constexpr std::uint8_t wire_version = 1;
inline constexpr std::size_t header_bytes = 8;
inline constexpr std::size_t crc_bytes = 4;
inline constexpr std::size_t max_body_bytes = 232;
inline constexpr std::size_t max_message_bytes = header_bytes + max_body_bytes + crc_bytes;
inline constexpr std::size_t max_frame_bytes = stuffed_bytes(max_message_bytes) + 2;

// From the gyro: telemetry, status, reply. To the gyro: command.
enum class MessageType : std::uint8_t { telemetry = 1, status = 2, command = 3, reply = 4 };

// One end of the line as it numbers what it sends.
struct Sender {
    std::uint16_t session = 0;   // another one after each start: the gyro counts its starts, a host takes any number
    std::uint32_t sequence = 0;  // of the next message, wraps
};

// Bytes of one frame, ready for the line.
struct Frame {
    std::array<std::uint8_t, max_frame_bytes> bytes{};
    std::size_t size = 0;

    [[nodiscard]] std::span<const std::uint8_t> view() const noexcept { return std::span{bytes}.first(size); }
};

// Number the body and put it into a frame.
//
// body  up to max_body_bytes; of more nothing is sent: a frame of size 0.
[[nodiscard]] Frame frame_of(Sender& sender, MessageType type, std::span<const std::uint8_t> body) noexcept;

// A message as it was sent, in the memory of its receiver.
struct Message {
    MessageType type = MessageType::telemetry;
    std::uint16_t session = 0;
    std::uint32_t sequence = 0;
    std::span<const std::uint8_t> body{};  // good until the receiver is fed again
};

struct Receiver {
    std::array<std::uint8_t, max_frame_bytes> held{};
    std::size_t n_held = 0;
    bool overflown = false;       // more bytes without a zero than a frame has
    std::uint32_t n_good = 0;     // frames, wraps; so do the others
    std::uint32_t n_damaged = 0;  // what stood between two zeros and is no frame of ours, by form, length or CRC
    std::uint64_t n_skipped = 0;  // bytes of them
    std::uint32_t n_foreign = 0;  // good frames of another version
};

// Take bytes off the front of `bytes` up to the end of the next good message; false where they have been used up.
//
// Whatever the bytes are, only whole messages with the right CRC come out. Memory and time per byte are bounded.
[[nodiscard]] bool receive(Receiver& receiver, std::span<const std::uint8_t>& bytes, Message& message) noexcept;

}  // namespace zlg::wire
