// The watchdog of the machine (CMSDK): without a kick for 251 ms a non-maskable interrupt, after as long again a reset.

#include <zlg/firmware/half_period.hpp>
#include <zlg/firmware/port.hpp>

#include "board.hpp"
#include "registers.hpp"

namespace zlg::firmware {
namespace {

using namespace mps2;

// No multiple of a usual half-period, so that the interrupt finds what hangs, and not always the half-period's
// interrupt.
constexpr std::uint32_t deadline_ms = 251;
std::uint32_t halves_at_kick = 0;

}  // namespace

namespace mps2 {

void start_watchdog() noexcept {
    watchdog.lock() = Watchdog::unlocked;
    watchdog.load() = deadline_ms * (clock_hz / 1000);
    watchdog.control() = Watchdog::interrupt | Watchdog::reset;
    watchdog.lock() = 0;
}

// Whether half-periods still end: one may have ended just after the kick, so two are the proof.
bool is_half_period_alive() noexcept { return halves() - halves_at_kick > 1; }

}  // namespace mps2

namespace port {

void kick_watchdog() noexcept {
    halves_at_kick = halves();
    watchdog.lock() = Watchdog::unlocked;
    watchdog.clear() = 1;
    watchdog.lock() = 0;
}

}  // namespace port
}  // namespace zlg::firmware
