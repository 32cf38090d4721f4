#pragma once
// The end of a half-period: what the board's interrupt runs.

#include <cstdint>
#include <optional>

#include <zlg/firmware/gyro.hpp>
#include <zlg/wire/status.hpp>

namespace zlg::firmware {

// The gyro of this processor. Start-up code leaves it all zeros: start it before its first half.
[[nodiscard]] Gyro& gyro() noexcept;

// Begin anew: the gyro, and what is told of it. The settings have passed `check`; no half-period may end meanwhile.
//
// counter  reading of the fringe counter when the first half begins; where it is not known the first half is not counted.
// return   what is commanded for the first half.
core::ActuatorFrame start_gyro(const Settings& settings, std::optional<std::uint64_t> counter = {}) noexcept;

// What the background does to it, each with the interrupt kept away.
//
// gyro_takes  go on with other settings, which have passed `check`; false in the middle of a tick: ask again.
[[nodiscard]] bool gyro_takes(const Settings& settings) noexcept;
void hold_switching(bool held) noexcept;
void force_switch() noexcept;  // once, as soon as the gyro is ready for it
[[nodiscard]] wire::Status status_of_gyro(const core::GyroCompensationConfig& config) noexcept;

// What the last half has brought, for whoever looks on; whole while the interrupt is kept away.
[[nodiscard]] const HalfOutput& last_half() noexcept;

// Done since the start, wraps. May be asked from anywhere.
[[nodiscard]] std::uint32_t halves() noexcept;

// Take the frame that the board has latched and give its command. Called from the board's interrupt.
void half_period() noexcept;

}  // namespace zlg::firmware
