#include "background.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <span>

#include <zlg/firmware/half_period.hpp>
#include <zlg/firmware/port.hpp>
#include <zlg/firmware/stored.hpp>
#include <zlg/wire/status.hpp>

#include "telemetry_queue.hpp"

namespace zlg::firmware {
namespace {

// Mostly zeros, which need not lie in the flash.
alignas(Background) constinit std::array<std::byte, sizeof(Background)> memory{};

constexpr wire::CommandResult result_of(StoredFault fault) noexcept {
    using enum wire::CommandResult;
    constexpr std::array results{done, damaged, damaged, other_program, not_allowed};  // of none, other_kind, ...
    return results[static_cast<std::size_t>(fault)];
}

// Bytes of commands that one round takes.
constexpr std::size_t bytes_a_round = 64;

}  // namespace

Background& background() noexcept {
    static Background& the_background = *std::construct_at(reinterpret_cast<Background*>(memory.data()));
    return the_background;
}

void Background::start(std::uint32_t settings_crc, std::uint16_t session) noexcept {
    settings_crc_ = settings_crc;
    sender_.session = session;
}

void Background::run() noexcept {
    send_rest();
    if (restart_due_ && sent_ == out_.size) port::restart();
    // One frame after the other: an answer first, for somebody waits for it.
    if (sent_ == out_.size) listen();
    send();
    gyro().work([]() noexcept { background().send(); });
}

void Background::send() noexcept {
    send_rest();
    if (sent_ == out_.size && status_due_) send_status();
    if (sent_ == out_.size) send_tick();
}

void Background::queue(const wire::Frame& frame) noexcept {
    out_ = frame;
    sent_ = 0;
    send_rest();
}

void Background::send_rest() noexcept { sent_ += port::send(out_.view().subspan(sent_)); }

void Background::send_tick() noexcept {
    wire::Telemetry news;
    if (!telemetry_queue().take(news)) return;
    health_ = news.health;
    queue(frame_of(sender_, news));
    if (++ticks_since_status_ * news.tick_s >= 1.0) status_due_ = true;
}

void Background::send_status() noexcept {
    wire::Status now = status_of_gyro();
    now.health = health_;
    now.settings_crc = settings_crc_;
    now.n_received = receiver_.n_good;
    now.n_damaged = receiver_.n_damaged;
    now.n_overruns = port::overruns();
    now.stack_used_bytes = port::stack_used_bytes();
    now.last_fault = static_cast<std::uint32_t>(port::last_fault().kind);
    ticks_since_status_ = 0;
    status_due_ = false;
    queue(frame_of(sender_, now));
}

void Background::listen() noexcept {
    std::array<std::uint8_t, 1> byte{};
    wire::Message message;
    for (std::size_t k = 0; k < bytes_a_round && port::receive(byte) == byte.size(); ++k) {
        std::span<const std::uint8_t> bytes{byte};
        if (!receive(receiver_, bytes, message)) continue;
        wire::CommandOutput out = handle(commands_, message);
        if (!out.has_reply) continue;
        if (out.due == wire::CommandCode::load) {
            load(*piece_in(message), out.reply);
            commands_.last = out.reply;
        } else if (out.due) {
            execute(*out.due);
        }
        return queue(frame_of(sender_, out.reply));
    }
}

void Background::load(const wire::SettingsPiece& piece, wire::Reply& reply) noexcept {
    using enum wire::CommandResult;
    if (!piece.bytes.empty()) {
        if (!port::stage(piece.offset, piece.bytes)) reply.result = malformed;
        return;
    }
    const auto bytes = port::staged().first(std::min<std::size_t>(piece.offset, port::staged().size()));
    const StoredFault fault = fault_of(bytes);
    if (fault == StoredFault::refused) {
        const SettingsFault why = check(settings_in(bytes));
        const bool by_control = why.control != core::GyroControlFault::none;
        reply.part = by_control ? wire::RefusingPart::control : wire::RefusingPart::compensation;
        reply.fault = by_control ? static_cast<std::uint8_t>(why.control) : static_cast<std::uint8_t>(why.compensation);
    }
    reply.result = result_of(fault);
    if (reply.result != done) return;
    if (is_switching()) {
        reply.result = switch_under_way;
        return;
    }
    execute(wire::CommandCode::stop_switching);
    port::store(settings_in(bytes));
    restart_due_ = true;
}

void Background::execute(wire::CommandCode command) noexcept {
    using Code = wire::CommandCode;
    if (command == Code::read_state) status_due_ = true;
    const port::Quiet quiet;
    if (command == Code::stop_switching || command == Code::start_switching)
        gyro().hold_switching(command == Code::stop_switching);
    if (command == Code::force_switch) gyro().force_switch();
}

}  // namespace zlg::firmware
