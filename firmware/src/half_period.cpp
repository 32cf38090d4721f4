#include <zlg/firmware/half_period.hpp>

#include <array>
#include <atomic>
#include <cstddef>
#include <memory>
#include <new>

#include <zlg/firmware/port.hpp>
#include <zlg/firmware/stored.hpp>

#include "background.hpp"
#include "telemetry_queue.hpp"

namespace zlg::firmware {
namespace {

// Most of its initial state is zeros: were it initialised by the compiler, they would all lie in the flash as well.
alignas(Gyro) constinit std::array<std::byte, sizeof(Gyro)> memory{};

constinit std::atomic<std::uint32_t> n_halves{};

// Ended in a lock, as asked for and otherwise; both wrap.
constinit std::uint32_t n_switches = 0;
constinit std::uint32_t n_failed = 0;

void count(const core::GyroControlOutput& control) noexcept {
    if (!control.has_event) return;
    ++(control.event.outcome == core::SwitchOutcome::switched ? n_switches : n_failed);
}

constinit HalfOutput last{};

// When the last half ended.
constinit std::uint64_t end_ticks = 0;

// Without a latch the half was as long as it should be.
void note_end(const Settings& settings, const core::SensorFrame& frame) noexcept {
    const bool is_missed = (frame.status & core::frame_missed) != 0;
    end_ticks = is_missed ? end_ticks + settings.control.commutator.half_ticks : frame.timer_ticks;
}

// Apart, so that the interrupt need not save the registers that this takes.
[[gnu::noinline]] Gyro& construct_gyro() noexcept { return *std::construct_at(reinterpret_cast<Gyro*>(memory.data())); }

}  // namespace

Gyro& gyro() noexcept {
    static Gyro& the_gyro = construct_gyro();
    return the_gyro;
}

core::ActuatorFrame start_gyro(const Settings& settings, std::optional<std::uint64_t> counter) noexcept {
    telemetry_queue().restart();
    background().start(settings_crc(settings), static_cast<std::uint16_t>(port::starts()));
    const core::ActuatorFrame first = gyro().start(settings, counter.value_or(0));
    if (!counter) gyro().forget_counter();
    gyro().work_in_background();
    return first;
}

// A gyro that has no light, or not yet its own settings, searches for a mode without end.
bool is_switching() noexcept {
    using enum core::SwitchPhase;
    const port::Quiet quiet;
    const core::ModeSwitchState& state = gyro().state().control.mode_switch;
    return state.phase == open || state.phase == returning || (state.phase == settling && state.switching);
}

wire::Status status_of_gyro() noexcept {
    const port::Quiet quiet;
    const GyroState& state = gyro().state();
    wire::Status status = wire::status_of(state.control, state.compensation, gyro().settings().compensation);
    status.n_switches = n_switches;
    status.n_failed = n_failed;
    return status;
}

const HalfOutput& last_half() noexcept { return last; }

std::uint32_t halves() noexcept { return n_halves.load(std::memory_order_acquire); }

void on_half_period() noexcept {
    Gyro& it = gyro();
    const core::SensorFrame& frame = port::latched();
    note_end(it.settings(), frame);
    // Made where it stays: a copy of it would cost more than most parts of the core.
    const HalfOutput& output = *::new (&last) HalfOutput{it.half(frame)};
    port::command(output.control.actuator);
    count(output.control);
    if (port::has_line())
        telemetry_queue().put(output, time_of(end_ticks, port::last_pulse()),
                              it.settings().compensation.gyro.tick.value());
    n_halves.store(n_halves.load(std::memory_order_relaxed) + 1, std::memory_order_release);
}

}  // namespace zlg::firmware
