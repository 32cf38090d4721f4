#pragma once
// The memory that host and processor share when the processor is driven in lock step.
//
// The structures of the core cross it as they lie in memory. That is sound only where both sides were compiled from the
// same core for the same layout, so each side states what it was compiled from, and nothing is read before both agree.

#include <atomic>
#include <bit>
#include <cstdint>
#include <type_traits>

#include <zlg/firmware/fault.hpp>
#include <zlg/firmware/gyro.hpp>
#include <zlg/firmware/pulse.hpp>

namespace zlg::firmware {

enum class Request : std::uint32_t {
    none,
    start,         // judge the settings, begin anew
    start_stored,  // the same with those that the flash holds
    half,          // one half-period
    drain,         // one report of what is still due
    state          // lay open the state
};

// What the processor says of itself before the first request.
// `restarted`: it has begun anew since it was ready, and remembers nothing.
enum class Readiness : std::uint32_t { absent, ready, refused, restarted };

struct Exchange {
    // Written by the host before the processor starts.
    std::uint32_t magic = 0;     // the processor is to be driven in lock step
    std::uint32_t has_line = 0;  // 1: somebody listens on the serial line
    std::uint32_t has_bell = 0;  // 1: a byte on the bell's line wakes whoever sleeps
    std::uint64_t host_layout = 0;

    // Written by the processor once.
    std::uint64_t processor_layout = 0;
    std::atomic<std::uint32_t> readiness{};
    FaultRecord ended{};  // why it has begun anew

    // The host writes its part, then the number of the request; the processor answers, then writes that number.
    std::atomic<std::uint32_t> asked{};
    std::atomic<std::uint32_t> answered{};
    Request request = Request::none;

    // 1 while that side may sleep: who has news for it rings the bell.
    std::atomic<std::uint32_t> host_sleeps{};
    std::atomic<std::uint32_t> processor_sleeps{};

    // Host to processor.
    Settings settings{};
    std::uint64_t counter = 0;
    core::SensorFrame sensor{};
    Pulse pulse{};

    // Processor to host.
    std::uint32_t has_stored = 0;
    SettingsFault fault{};
    core::ActuatorFrame first_actuator{};
    HalfOutput output{};
    core::DrainOutput drained{};
    GyroState state{};
    std::uint32_t stack_used_bytes = 0;  // beside the state: the most so far
};

inline constexpr std::uint32_t lock_step_magic = 0x5a4c4731;

static_assert(std::endian::native == std::endian::little, "the numbers cross as they lie in memory");
static_assert(std::atomic<std::uint32_t>::is_always_lock_free && sizeof(std::atomic<std::uint32_t>) == 4);
static_assert(std::is_trivially_copyable_v<Settings> && std::is_trivially_copyable_v<core::SensorFrame> &&
              std::is_trivially_copyable_v<HalfOutput> && std::is_trivially_copyable_v<core::DrainOutput> &&
              std::is_trivially_copyable_v<GyroState> && std::is_trivially_copyable_v<Pulse> &&
              std::is_trivially_copyable_v<FaultRecord>);

// A number of the sources of the core and of how the compiler lays them out: equal on both sides or nothing may cross.
//
// With the same declarations, the sizes and alignments of the elementary types decide the place of every field.
[[nodiscard]] std::uint64_t layout() noexcept;

}  // namespace zlg::firmware
