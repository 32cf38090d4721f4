#pragma once
// The end of a half-period: what the board's interrupt runs.

#include <cstdint>
#include <optional>

#include <zlg/firmware/gyro.hpp>
#include <zlg/wire/status.hpp>

namespace zlg::firmware {

// The gyro of this processor. Start-up code leaves it all zeros: start it before its first half.
[[nodiscard]] Gyro& gyro() noexcept;

// Begin anew: the gyro and its telemetry. The settings have passed `check`; no half-period may end meanwhile.
//
// counter  reading of the fringe counter when the first half begins; where it is not known the first half is not
// counted. return   what is commanded for the first half.
core::ActuatorFrame start_gyro(const Settings& settings, std::optional<std::uint64_t> counter = {}) noexcept;

// Called by the background (background.hpp); each masks the interrupt while it works.
[[nodiscard]] bool is_switching() noexcept;  // from the opening of the loop to the lock, or until the mode is searched
[[nodiscard]] wire::Status status_of_gyro() noexcept;

// The outputs of the last half, for telemetry; consistent while the interrupt is masked.
[[nodiscard]] const HalfOutput& last_half() noexcept;

// Half-periods ended since the start, modulo 2^32; from any context.
[[nodiscard]] std::uint32_t halves() noexcept;

// Take the frame that the board has latched and give its command. Called from the board's interrupt.
void on_half_period() noexcept;

}  // namespace zlg::firmware
