#include <zlg/wire/frame.hpp>

#include <zlg/wire/crc.hpp>

#include "packing.hpp"

namespace zlg::wire {
namespace {

// A block is its length and up to 254 bytes; one that is shorter stands for a zero behind them.
constexpr std::uint8_t full_block = 0xFF;

}  // namespace

std::size_t stuff(std::span<const std::uint8_t> bytes, std::span<std::uint8_t> out) noexcept {
    std::size_t block = 0;
    std::size_t at = 1;
    std::uint8_t length = 1;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        if (bytes[i] != 0) {
            out[at++] = bytes[i];
            ++length;
        }
        const bool full = length == full_block && i + 1 < bytes.size();
        if (bytes[i] != 0 && !full) continue;
        out[block] = length;
        block = at++;
        length = 1;
    }
    out[block] = length;
    return at;
}

Unstuffed unstuff(std::span<std::uint8_t> bytes) noexcept {
    std::size_t from = 0;
    std::size_t to = 0;
    while (from < bytes.size()) {
        const std::size_t length = bytes[from++];
        if (length == 0 || from + length - 1 > bytes.size()) return {};
        for (std::size_t k = 1; k < length; ++k) {
            if (bytes[from] == 0) return {};
            bytes[to++] = bytes[from++];
        }
        if (length != full_block && from < bytes.size()) bytes[to++] = 0;
    }
    return {.good = to > 0, .size = to};
}

namespace {

// The message that the bytes between two zeros are, if they are one.
bool take_message(Receiver& r, Message& message) noexcept {
    const Unstuffed unstuffed = unstuff(std::span{r.held}.first(r.n_held));
    if (!unstuffed.good || unstuffed.size < header_bytes + crc_bytes || unstuffed.size > max_message_bytes)
        return false;
    const auto bytes = std::span<const std::uint8_t>{r.held}.first(unstuffed.size);
    const auto covered = bytes.first(bytes.size() - crc_bytes);
    std::uint32_t crc = 0;
    Unpacker{bytes.last(crc_bytes)}(crc);
    if (crc != crc32c(covered)) return false;
    std::uint8_t version = 0;
    Unpacker header{covered};
    header(version);
    if (version != wire_version) {
        ++r.n_foreign;
        return false;
    }
    header(message.type, message.session, message.sequence);
    message.body = covered.subspan(header_bytes);
    return true;
}

// The zero has come.
bool end_frame(Receiver& r, Message& message) noexcept {
    if (r.n_held == 0 && !r.overflown) return false;
    const bool good = !r.overflown && take_message(r, message);
    if (good) {
        ++r.n_good;
    } else {
        ++r.n_damaged;
        r.n_skipped += r.n_held;
    }
    r.n_held = 0;
    r.overflown = false;
    return good;
}

}  // namespace

Frame frame_of(Sender& sender, MessageType type, std::span<const std::uint8_t> body) noexcept {
    Frame frame;
    if (body.size() > max_body_bytes) return frame;
    Packer message;
    message(wire_version, type, sender.session, sender.sequence++);
    for (const std::uint8_t byte : body) message(byte);
    message(crc32c(message.body()));
    // The array is of zeros: those in front and behind stand there.
    frame.size = 2 + stuff(message.body(), std::span{frame.bytes}.subspan(1));
    return frame;
}

bool receive(Receiver& receiver, std::span<const std::uint8_t>& bytes, Message& message) noexcept {
    while (!bytes.empty()) {
        const std::uint8_t byte = bytes.front();
        bytes = bytes.subspan(1);
        if (byte == 0) {
            if (end_frame(receiver, message)) return true;
        } else if (receiver.n_held < receiver.held.size()) {
            receiver.held[receiver.n_held++] = byte;
        } else {
            receiver.overflown = true;
            ++receiver.n_skipped;
        }
    }
    return false;
}

}  // namespace zlg::wire
