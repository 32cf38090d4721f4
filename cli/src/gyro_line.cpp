#include "gyro_line.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>

#include <fmt/format.h>

#include <zlg/logs/byte_source.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/wire/command.hpp>

#include "interrupt.hpp"
#include "output.hpp"

namespace zlg::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds reply_patience{200};
constexpr int most_tries = 10;

// A number that no host before this one has used just now.
std::uint16_t any_session() {
    return static_cast<std::uint16_t>(std::chrono::system_clock::now().time_since_epoch().count() >> 16);
}

std::string why_not(const wire::Reply& reply) {
    using enum wire::CommandResult;
    switch (reply.result) {
        case done: return "";
        case damaged: return "they did not come whole";
        case other_program: return "they are for the image of another version than this gyro has";
        case switch_under_way: return "a switch is under way; try again when it has ended";
        case not_allowed:
            return fmt::format("its core refuses them, {} fault {}",
                               reply.part == wire::RefusingPart::control ? "control" : "compensation", reply.fault);
        case malformed: break;
    }
    return "it does not know the command; its image is older";
}

class Line {
public:
    Line(const std::string& name, int baud) : name_{name}, bytes_{name, baud, logs::ByteSource::Access::both} {}

    // The reply to a piece, which is sent again until it comes.
    wire::Reply ask(const wire::SettingsPiece& piece) {
        const std::uint32_t sequence = sender_.sequence;
        const wire::Frame frame = frame_of(sender_, piece);
        for (int k = 0; k < most_tries; ++k) {
            bytes_.write(frame.view());
            if (const auto reply = listen(sequence)) return *reply;
        }
        throw logs::IoError{fmt::format("{}: no answer from a gyro", printable(name_))};
    }

private:
    std::optional<wire::Reply> listen(std::uint32_t sequence) {
        const auto end = Clock::now() + reply_patience;
        while (Clock::now() < end) {
            check_interrupt();
            std::array<std::uint8_t, 512> room{};
            std::size_t n = 0;
            const auto read = bytes_.read(room, n, 20);
            if (read == logs::ByteSource::Read::end)
                throw logs::IoError{fmt::format("{}: the line has ended", printable(name_))};
            if (read != logs::ByteSource::Read::bytes) continue;
            std::span<const std::uint8_t> bytes = std::span{room}.first(n);
            for (wire::Message message; receive(receiver_, bytes, message);)
                if (const auto reply = reply_in(message);
                    reply && reply->session == sender_.session && reply->sequence == sequence)
                    return reply;
        }
        return std::nullopt;
    }

    std::string name_;
    logs::ByteSource bytes_;
    wire::Sender sender_{.session = any_session()};
    wire::Receiver receiver_;
};

}  // namespace

void load_over_line(const std::string& line, int baud, std::span<const std::uint8_t> settings) {
    Line gyro{line, baud};
    for (std::size_t at = 0; true; at += wire::max_piece_bytes) {
        at = std::min(at, settings.size());
        const auto piece = settings.subspan(at, std::min(wire::max_piece_bytes, settings.size() - at));
        const wire::Reply reply = gyro.ask({.offset = static_cast<std::uint16_t>(at), .bytes = piece});
        if (const std::string why = why_not(reply); !why.empty())
            throw logs::IoError{
                fmt::format("{}: the gyro keeps its old settings and not these: {}", printable(line), why)};
        if (piece.empty()) return;
    }
}

}  // namespace zlg::cli
