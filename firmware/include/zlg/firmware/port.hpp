#pragma once
// What a board gives the gyro: frames in, frames out, the half-period's timer, a serial line.
//
// Every function here is to be replaced for another board, and nothing else is; see docs/firmware.md.

#include <cstddef>
#include <cstdint>
#include <span>

#include <zlg/core/records.hpp>
#include <zlg/firmware/fault.hpp>
#include <zlg/firmware/gyro.hpp>
#include <zlg/firmware/pulse.hpp>

namespace zlg::firmware::port {

// Make the board ready; the half-period's interrupt does not come yet. Called once, first of all.
void start() noexcept;

// Let the interrupt come at every end of a half-period, in which it calls `half_period`.
//
// half_ticks  of the gyro's timer.
void start_half_periods(std::uint64_t half_ticks) noexcept;

// What was latched at the end of this half-period. Called once in each interrupt; valid until the next.
//
// return  a frame with status `frame_missed` where nothing was received.
[[nodiscard]] const core::SensorFrame& latched() noexcept;

// The last pulse of a clock outside that came before the end of this half-period. Called in the interrupt, where there
// is a line.
[[nodiscard]] Pulse last_pulse() noexcept;

// What is in force from the start of the next half-period.
void command(const core::ActuatorFrame& actuator) noexcept;

// Somebody may listen on the serial line: without, no telemetry is made.
[[nodiscard]] bool has_line() noexcept;

// The serial line of telemetry and commands. Neither waits: they move as many bytes as can be moved now, and say how
// many.
std::size_t send(std::span<const std::uint8_t> bytes) noexcept;
std::size_t receive(std::span<std::uint8_t> bytes) noexcept;

// Settings in memory that outlives a loss of power: null where there are none, or they are of another program.
void store(const Settings& settings) noexcept;
[[nodiscard]] const Settings* stored() noexcept;

// The same memory has a second place, for settings that come in pieces: nothing starts with what is there.
//
// stage   false, and nothing is written, where the place ends before the piece does.
// staged  the whole place.
[[nodiscard]] bool stage(std::size_t offset, std::span<const std::uint8_t> bytes) noexcept;
[[nodiscard]] std::span<const std::uint8_t> staged() noexcept;

// Begin anew, with what is stored, once what was given to `send` is out.
[[noreturn]] void restart() noexcept;

// Without a call for a quarter of a second the board notes why and begins anew. To be called by the background, and
// only when a half-period has ended since the last call: so it shows that both are alive.
void kick_watchdog() noexcept;

// Why the start before this one ended; kind `none` after power.
[[nodiscard]] const FaultRecord& last_fault() noexcept;

// Starts since power, this one included.
[[nodiscard]] std::uint32_t starts() noexcept;

// Half-periods so far whose work was not done when the next one ended.
[[nodiscard]] std::uint32_t overruns() noexcept;

// The most that the stack has held so far. Takes some thousand instructions.
[[nodiscard]] std::uint32_t stack_used_bytes() noexcept;

// For what must not happen: the board notes where and begins anew.
[[noreturn]] void fail(std::uint32_t detail) noexcept;

// While one lives, no interrupt comes.
class Quiet {
public:
    Quiet() noexcept;
    ~Quiet();
    Quiet(const Quiet&) = delete;
    Quiet& operator=(const Quiet&) = delete;

private:
    std::uint32_t before_;
};

// Wait for an interrupt, with little current.
void idle() noexcept;

}  // namespace zlg::firmware::port
