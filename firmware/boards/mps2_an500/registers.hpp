#pragma once
// Registers of the processor and of the machine's devices, by their addresses.

#include <cstdint>

namespace zlg::firmware::mps2 {

// A register at this address; reads and writes of it happen as they stand.
[[nodiscard]] inline volatile std::uint32_t& reg(std::uint32_t address) noexcept {
    return *reinterpret_cast<volatile std::uint32_t*>(address);
}

inline constexpr std::uint32_t clock_hz = 25'000'000;

// CMSDK timers: they count down from `reload` and interrupt at 0.
struct Timer {
    std::uint32_t base;
    [[nodiscard]] volatile std::uint32_t& control() const noexcept { return reg(base); }
    [[nodiscard]] volatile std::uint32_t& value() const noexcept { return reg(base + 0x4); }
    [[nodiscard]] volatile std::uint32_t& reload() const noexcept { return reg(base + 0x8); }
    [[nodiscard]] volatile std::uint32_t& clear() const noexcept { return reg(base + 0xc); }
    static constexpr std::uint32_t enable = 1u << 0;
    static constexpr std::uint32_t interrupt = 1u << 3;
};
inline constexpr Timer half_timer{0x40000000};
inline constexpr Timer free_timer{0x40001000};

// CMSDK UARTs.
struct Uart {
    std::uint32_t base;
    [[nodiscard]] volatile std::uint32_t& data() const noexcept { return reg(base); }
    [[nodiscard]] volatile std::uint32_t& state() const noexcept { return reg(base + 0x4); }
    [[nodiscard]] volatile std::uint32_t& control() const noexcept { return reg(base + 0x8); }
    [[nodiscard]] volatile std::uint32_t& clear() const noexcept { return reg(base + 0xc); }
    [[nodiscard]] volatile std::uint32_t& baud_divider() const noexcept { return reg(base + 0x10); }
    static constexpr std::uint32_t send_full = 1u << 0;     // of the state
    static constexpr std::uint32_t receive_full = 1u << 1;  // of the state, and to clear it
    static constexpr std::uint32_t send = 1u << 0;          // of the control
    static constexpr std::uint32_t receive = 1u << 1;       // of the control
    static constexpr std::uint32_t receive_irq = 1u << 3;   // of the control
};
inline constexpr Uart uart0{0x40004000};  // telemetry and commands
inline constexpr Uart uart1{0x40005000};  // the bench
inline constexpr Uart uart2{0x40006000};  // the bell of the host in lock step

// CMSDK watchdog: it counts down from `load`, interrupts at 0, and at the next 0 resets.
struct Watchdog {
    std::uint32_t base;
    [[nodiscard]] volatile std::uint32_t& load() const noexcept { return reg(base); }
    [[nodiscard]] volatile std::uint32_t& control() const noexcept { return reg(base + 0x8); }
    [[nodiscard]] volatile std::uint32_t& clear() const noexcept { return reg(base + 0xc); }
    [[nodiscard]] volatile std::uint32_t& lock() const noexcept { return reg(base + 0xc00); }
    static constexpr std::uint32_t interrupt = 1u << 0;  // of the control
    static constexpr std::uint32_t reset = 1u << 1;      // of the control
    static constexpr std::uint32_t unlocked =
        0x1acce551;  // of the lock; with any other its registers cannot be written
};
inline constexpr Watchdog watchdog{0x40008000};

// The processor's memory protection unit.
struct Protection {
    [[nodiscard]] volatile std::uint32_t& control() const noexcept { return reg(0xe000ed94); }
    [[nodiscard]] volatile std::uint32_t& number() const noexcept { return reg(0xe000ed98); }
    [[nodiscard]] volatile std::uint32_t& base() const noexcept { return reg(0xe000ed9c); }
    [[nodiscard]] volatile std::uint32_t& attributes() const noexcept { return reg(0xe000eda0); }
    static constexpr std::uint32_t enable = 1u << 0;  // of the control; off in the handlers of faults
    static constexpr std::uint32_t rest_by_default =
        1u << 2;  // of the control: what no region covers is as without the unit
};
inline constexpr Protection protection{};

// What the processor says of its faults.
[[nodiscard]] inline std::uint32_t fault_status() noexcept { return reg(0xe000ed28); }
[[nodiscard]] inline std::uint32_t hard_fault_status() noexcept { return reg(0xe000ed2c); }
[[nodiscard]] inline std::uint32_t forbidden_address() noexcept { return reg(0xe000ed34); }
[[nodiscard]] inline std::uint32_t bus_fault_address() noexcept { return reg(0xe000ed38); }

// The lowest bit of it: registers of the floating-point unit wait to be stored.
[[nodiscard]] inline volatile std::uint32_t& fpccr() noexcept { return reg(0xe000ef34); }

inline void trap_division_by_zero() noexcept { reg(0xe000ed14) = reg(0xe000ed14) | 1u << 4; }

// Numbers of the interrupts.
inline constexpr std::uint32_t uart0_receive_irq = 0;
inline constexpr std::uint32_t uart2_receive_irq = 4;
inline constexpr std::uint32_t half_timer_irq = 8;

// The interrupt controller of the processor.
inline void enable_irq(std::uint32_t n) noexcept { reg(0xe000e100 + 4 * (n / 32)) = 1u << (n % 32); }
inline void pend_irq(std::uint32_t n) noexcept { reg(0xe000e200 + 4 * (n / 32)) = 1u << (n % 32); }
inline void set_irq_priority(std::uint32_t n, std::uint8_t priority) noexcept {
    *reinterpret_cast<volatile std::uint8_t*>(0xe000e400 + n) = priority;
}

// What was written is in force before the next instruction.
inline void barrier() noexcept { asm volatile("dsb\n isb" ::: "memory"); }

// Processor and devices begin anew; the memory stays.
[[noreturn]] inline void system_reset() noexcept {
    reg(0xe000ed0c) = 0x05fa0004;
    barrier();
    for (;;) {
    }
}

}  // namespace zlg::firmware::mps2
