#pragma once
// What the vectors point to.

namespace zlg::firmware {

void on_half_timer() noexcept;
void on_uart0_receive() noexcept;
void on_uart1_receive() noexcept;
void on_uart2_receive() noexcept;

// Every exception that nobody expects.
void on_fault();

}  // namespace zlg::firmware
