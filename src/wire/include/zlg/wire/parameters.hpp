#pragma once
// The parameters of the core that have a number on the wire.

#include <cstdint>
#include <span>
#include <string_view>

#include <zlg/core/gyro_compensation.hpp>
#include <zlg/core/gyro_control.hpp>
#include <zlg/wire/command.hpp>

namespace zlg::wire {

// What the gyro runs by.
struct GyroSettings {
    core::GyroControlConfig control{};
    core::GyroCompensationConfig compensation{};
};

enum class ParameterAccess : std::uint8_t { read_write, read_only };

struct ParameterInfo {
    std::uint16_t key;
    ParameterAccess access;
};

// All of them, by rising key.
[[nodiscard]] std::span<const ParameterInfo> parameters() noexcept;

// Module and member of the core's configuration, with the unit; empty for an unknown key.
[[nodiscard]] std::string_view parameter_name(std::uint16_t key) noexcept;

// NaN for an unknown key.
[[nodiscard]] double parameter(const GyroSettings& settings, std::uint16_t key) noexcept;

// Put a value where the key says, without a check of the whole.
//
// return  `done`, `unknown_key`, `read_only` or `not_a_value`; the settings are as before unless `done`.
[[nodiscard]] CommandResult put_parameter(GyroSettings& settings, std::uint16_t key, double value) noexcept;

// CRC-32C over all values in the order of their keys, little-endian doubles: whether two gyros are set alike.
[[nodiscard]] std::uint32_t settings_crc(const GyroSettings& settings) noexcept;

}  // namespace zlg::wire
