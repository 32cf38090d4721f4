// The image of the processor in closed loop with the twin: half-periods a second.
//
// usage: zlg_lock_step IMAGE [HALVES]

#include <chrono>
#include <cstdint>

#include <fmt/format.h>

#include <zlg/config/config.hpp>
#include <zlg/processor/qemu.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/wiring.hpp>

namespace {

using namespace zlg;
using Clock = std::chrono::steady_clock;

double halves_per_second(rig::ClosedLoop& loop, std::int64_t halves) {
    const auto start = Clock::now();
    for (std::int64_t k = 0; k < halves; ++k) (void)loop.advance();
    return static_cast<double>(halves) / std::chrono::duration<double>(Clock::now() - start).count();
}

void measure(const char* what, const config::Config& config, const processor::QemuOptions& options,
             std::int64_t halves) {
    processor::QemuProcessor processor{options};
    rig::ClosedLoop outside{config, rig::motion(config), &processor};
    rig::ClosedLoop here{config, rig::motion(config)};
    (void)halves_per_second(outside, halves / 10);
    fmt::print("{:<24}{:>10.0f} half-periods a second in lock step, {:>10.0f} on the host\n", what,
               halves_per_second(outside, halves), halves_per_second(here, halves));
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        fmt::print(stderr, "usage: zlg_lock_step IMAGE [HALVES]\n");
        return 2;
    }
    const std::int64_t halves = argc > 2 ? std::atoll(argv[2]) : 200'000;
    config::Config config;
    measure("default", config, {.image = argv[1]}, halves);
    config.compensation.relock = core::RelockMethod::joint;
    measure("relock = joint", config, {.image = argv[1]}, halves);
    return 0;
}
