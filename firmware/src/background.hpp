#pragma once
// What the processor does between interrupts: sends one frame per tick, and executes commands.

#include <cstddef>
#include <cstdint>

#include <zlg/wire/command_handler.hpp>
#include <zlg/wire/frame.hpp>

namespace zlg::firmware {

class Background {
public:
    // settings_crc  of those that the gyro was started with.
    // session       number of this start; differs from that of the last.
    void start(std::uint32_t settings_crc, std::uint16_t session) noexcept;

    // One round. It sends what the line takes and never waits for it; while the gyro works it goes on sending.
    void run() noexcept;

private:
    void send() noexcept;
    void send_rest() noexcept;
    void send_tick() noexcept;
    void send_status() noexcept;
    void listen() noexcept;
    void execute(wire::CommandCode command) noexcept;
    void load(const wire::SettingsPiece& piece, wire::Reply& reply) noexcept;
    void queue(const wire::Frame& frame) noexcept;

    wire::CommandState commands_{};
    wire::Sender sender_{};
    wire::Receiver receiver_{};
    wire::Frame out_{};  // on its way
    std::size_t sent_ = 0;
    std::uint32_t settings_crc_ = 0;
    bool status_due_ = false;
    bool restart_due_ = false;  // once the reply is out
    std::uint32_t health_ = 0;
    std::uint32_t ticks_since_status_ = 0;
};

// That of this processor, all zeros until it is started.
[[nodiscard]] Background& background() noexcept;

}  // namespace zlg::firmware
