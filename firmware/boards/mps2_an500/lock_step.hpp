#pragma once
// The processor driven by a host, half-period by half-period, through memory that both see.

#include <zlg/firmware/exchange.hpp>

namespace zlg::firmware::mps2 {

// True where a host has asked for it before the processor started.
[[nodiscard]] bool is_in_lock_step() noexcept;

// Memory of the machine that a gyro's board has not: it serves nothing but this exchange.
[[nodiscard]] Exchange& exchange() noexcept;

// Say what this processor was compiled from; the host waits for it.
void present_to_host() noexcept;

// Look for a request for some time, then sleep until the host rings or an interrupt comes.
void wait_for_host() noexcept;

// Answer a request of the host, if there is one. A half-period runs in the half-period's interrupt, as it does by the
// timer.
void answer_host() noexcept;

}  // namespace zlg::firmware::mps2
