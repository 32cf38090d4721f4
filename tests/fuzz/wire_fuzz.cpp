// Any bytes on the line, and any messages in whole frames: what comes out can be logged, every command has its
// reply, and the decoder forgets noise at the next frame.

#include <cmath>
#include <cstdint>
#include <vector>

#include <zlg/logs/wire_rows.hpp>
#include <zlg/wire/command_handler.hpp>

#include "bytes.hpp"
#include "claim.hpp"

namespace {

using namespace zlg;
using fuzz::Bytes;
using fuzz::claim;

// Some bytes as they are, or as the body of a frame that its receiver must believe.
std::vector<std::uint8_t> piece_from(Bytes& bytes, wire::Sender& sender) {
    const auto what = bytes.take<std::uint8_t>();
    std::vector<std::uint8_t> piece(bytes.take<std::uint8_t>());
    // Of the length that telemetry and status must have.
    if ((what & 7) == 4) piece.resize(108);
    if ((what & 7) == 5) piece.resize(96);
    for (std::uint8_t& byte : piece) byte = bytes.take<std::uint8_t>();
    if ((what & 8) != 0) return piece;
    if ((what & 16) != 0) sender = {bytes.take<std::uint8_t>(), bytes.take<std::uint32_t>()};
    const wire::Frame frame = frame_of(sender, static_cast<wire::MessageType>(1 + (what & 3)), piece);
    return {frame.view().begin(), frame.view().end()};
}

// A message that a gyro could send, with some numbers of its own.
std::vector<std::uint8_t> telemetry_from(Bytes& bytes, wire::Sender& sender, std::uint32_t& tick) {
    tick += bytes.take<std::uint8_t>();
    wire::Telemetry t{.tick = tick,
                      .has_tick = bytes.flag(),
                      .has_settled = bytes.flag(),
                      .settled_age_ticks = bytes.take<std::uint8_t>(),
                      .dtheta_arcsec = bytes.real(100.0),
                      .angle = bytes.take<std::uint64_t>(),
                      .settled_dtheta_arcsec = bytes.real(100.0),
                      .settled_final_arcsec = bytes.real(100.0),
                      .settled_sigma_arcsec = bytes.real(1.0),
                      .tick_s = 0.005};
    t.settled_angle = t.angle - bytes.take<std::uint32_t>();
    t.settled_final_angle = t.angle - bytes.take<std::uint32_t>();
    sender.sequence += bytes.take<std::uint8_t>();
    const wire::Frame frame = frame_of(sender, t);
    return {frame.view().begin(), frame.view().end()};
}

void claim_rows(logs::WireRows& rows, std::int64_t& next_tick) {
    // Of a long outage the rows are many and alike.
    core::AngleRow row;
    for (int k = 0; k < 1000 && rows.next(row); ++k) {
        claim(row.tick == next_tick++, "rows are numbered without holes");
        claim(std::isfinite(row.dtheta_arcsec) && std::isfinite(row.dtheta_final_arcsec), "angles are numbers");
        claim(row.sigma_arcsec >= 0.0, "sigma is 0 or more");
        claim(row.mode == 1 || row.mode == -1, "the mode is a sign");
        claim((row.flags & logs::flag_lost) == 0 || (row.flags & logs::flag_final_lost) != 0,
              "a lost tick has no final value");
    }
}

void claim_handled(wire::CommandState& state, wire::Receiver& receiver, std::span<const std::uint8_t> left) {
    wire::Message message;
    while (receive(receiver, left, message)) {
        const wire::CommandOutput out = handle(state, message);
        claim(out.has_reply == (message.type == wire::MessageType::command), "every command has its reply");
        claim(!out.due || out.reply.result == wire::CommandResult::done, "what is refused is not done");
        wire::Sender sender;
        claim(frame_of(sender, out.reply).size > 0, "a reply can be sent");
    }
}

void claim_rejoins(logs::WireRows& rows) {
    const std::uint64_t before = rows.summary().n_status;
    wire::Sender sender{.session = 65535, .sequence = 4};
    const wire::Frame frame = frame_of(sender, wire::Status{.tick_s = 0.005});
    rows.take(frame.view());
    claim(rows.summary().n_status == before + 1, "after anything, the next frame is taken");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes bytes{data, size};
    logs::WireRows rows;
    wire::CommandState state;
    wire::Receiver receiver;
    wire::Sender sender;
    std::uint32_t tick = 0;
    std::int64_t next_tick = 0;
    while (!bytes.empty()) {
        const auto piece = bytes.flag() ? telemetry_from(bytes, sender, tick) : piece_from(bytes, sender);
        rows.take(piece);
        claim_rows(rows, next_tick);
        claim_handled(state, receiver, piece);
    }
    claim_rejoins(rows);
    rows.end();
    claim_rows(rows, next_tick);
    return 0;
}
