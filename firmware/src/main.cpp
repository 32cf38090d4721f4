// The program of the gyro's processor: wiring only. The half-period's interrupt runs the core, the rest runs here.

#include <cstdint>

#include <zlg/firmware/half_period.hpp>
#include <zlg/firmware/port.hpp>

#include "background.hpp"

namespace {

// Until others are stored.
constexpr zlg::firmware::Settings defaults{};

}  // namespace

int main() {
    using namespace zlg::firmware;
    port::start();
    const Settings* const stored = port::stored();
    const Settings& settings = stored != nullptr ? *stored : defaults;
    port::command(start_gyro(settings));
    port::start_half_periods(settings.control.commutator.half_ticks);
    for (std::uint32_t seen = halves();;) {
        // Both must be alive: the half-periods, which are counted, and this loop, which looks.
        if (const std::uint32_t now = halves(); now != seen) {
            seen = now;
            port::kick_watchdog();
        }
        background().run();
        port::idle();
    }
}
