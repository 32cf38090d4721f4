#pragma once
// Parts of this board that only the board itself uses.

#include <cstdint>
#include <string_view>

namespace zlg::firmware::mps2 {

void start_uart() noexcept;

// Wakes the host, in lock step.
void ring_bell() noexcept;

// A line for the bench. It waits until the characters are out, but not for ever.
void tell_bench(std::string_view line) noexcept;

// Reads the reason of the last reset from the memory that kept it, for the port to report; a reason is reported once.
void recall_fault() noexcept;

// Faults that the processor leaves out unless it is asked: writing to code, leaving the memory, dividing by zero.
void protect_memory() noexcept;

// With what the stack is filled before anything runs: start-up knows the number as well.
inline constexpr std::uint32_t stack_paint = 0x5aa5c33c;

// From now on port::kick_watchdog is needed.
void start_watchdog() noexcept;

// Half-periods have ended since the watchdog was kicked.
[[nodiscard]] bool is_half_period_alive() noexcept;

}  // namespace zlg::firmware::mps2
