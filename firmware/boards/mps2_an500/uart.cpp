// The serial lines, without waiting: bytes that come are kept by the interrupt until somebody asks for them.

#include <array>
#include <atomic>

#include <zlg/firmware/port.hpp>

#include "board.hpp"
#include "handlers.hpp"
#include "registers.hpp"

namespace zlg::firmware {
namespace {

using namespace mps2;

// One side writes, the other reads; what does not fit is lost.
class Ring {
public:
    void put(std::uint8_t byte) noexcept {
        const std::uint32_t end = end_.load(std::memory_order_relaxed);
        if (end - begin_.load(std::memory_order_acquire) == bytes_.size()) return;
        bytes_[end % bytes_.size()] = byte;
        end_.store(end + 1, std::memory_order_release);
    }

    bool take(std::uint8_t& byte) noexcept {
        const std::uint32_t begin = begin_.load(std::memory_order_relaxed);
        if (begin == end_.load(std::memory_order_acquire)) return false;
        byte = bytes_[begin % bytes_.size()];
        begin_.store(begin + 1, std::memory_order_release);
        return true;
    }

private:
    std::array<std::uint8_t, 256> bytes_{};
    std::atomic<std::uint32_t> begin_{};
    std::atomic<std::uint32_t> end_{};
};

constinit Ring received;

}  // namespace

void on_uart0_receive() noexcept {
    uart0.clear() = Uart::receive_full;
    while ((uart0.state() & Uart::receive_full) != 0) received.put(static_cast<std::uint8_t>(uart0.data()));
}

void on_uart1_receive() noexcept { uart1.clear() = Uart::receive_full; }

// That it came is all.
void on_uart2_receive() noexcept {
    uart2.clear() = Uart::receive_full;
    while ((uart2.state() & Uart::receive_full) != 0) {
        [[maybe_unused]] const std::uint32_t byte = uart2.data();
    }
}

namespace mps2 {

void start_uart() noexcept {
    uart0.baud_divider() = 16;
    uart0.control() = Uart::send | Uart::receive | Uart::receive_irq;
    set_irq_priority(uart0_receive_irq, 0x80);
    enable_irq(uart0_receive_irq);
    uart1.baud_divider() = 16;
    uart1.control() = Uart::send;
    uart2.baud_divider() = 16;
    uart2.control() = Uart::send | Uart::receive | Uart::receive_irq;
    set_irq_priority(uart2_receive_irq, 0x80);
    enable_irq(uart2_receive_irq);
}

void ring_bell() noexcept { uart2.data() = 1; }

void tell_bench(std::string_view line) noexcept {
    for (const std::string_view part : {line, std::string_view{"\r\n"}})
        for (const char c : part) {
            for (int patience = 100'000; patience > 0 && (uart1.state() & Uart::send_full) != 0;) --patience;
            uart1.data() = static_cast<std::uint8_t>(c);
        }
}

}  // namespace mps2

namespace port {

std::size_t send(std::span<const std::uint8_t> bytes) noexcept {
    std::size_t sent = 0;
    while (sent < bytes.size() && (uart0.state() & Uart::send_full) == 0) uart0.data() = bytes[sent++];
    return sent;
}

std::size_t receive(std::span<std::uint8_t> bytes) noexcept {
    std::size_t taken = 0;
    while (taken < bytes.size() && received.take(bytes[taken])) ++taken;
    return taken;
}

}  // namespace port
}  // namespace zlg::firmware
