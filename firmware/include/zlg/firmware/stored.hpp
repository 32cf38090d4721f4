#pragma once
// Settings as bytes: in memory that outlives a loss of power, in a file of the host, and on the line that brings them.
//
//   kind 8 | layout 8 | settings, as they lie in memory | 0000 | CRC-32C over all before 4
//
// The structures of the core are no format that lasts: another program has another layout, and refuses them.

#include <cstddef>
#include <cstdint>
#include <span>

#include <zlg/firmware/gyro.hpp>

namespace zlg::firmware {

inline constexpr std::size_t stored_head_bytes = 16;
inline constexpr std::size_t stored_bytes = stored_head_bytes + sizeof(Settings) + 8;

// Of equal settings the bytes are equal, where the compiler can tell which bytes of a structure hold nothing.
//
// to  aligned as Settings.
void put_stored(const Settings& settings, std::span<std::uint8_t, stored_bytes> to) noexcept;

// CRC-32C over the settings alone: whether two gyros are set alike.
//
// settings  from `settings_in`, for what lies between the members counts as well.
[[nodiscard]] std::uint32_t settings_crc(const Settings& settings) noexcept;

enum class StoredFault : std::uint8_t {
    none,
    other_kind,     // no settings
    damaged,        // cut, or a bit is another one
    other_program,  // whole, of sources of another version
    refused         // by the core: `check` of them says why
};

[[nodiscard]] StoredFault fault_of(std::span<const std::uint8_t> bytes) noexcept;

// Of the program that can use them; 0 where there are too few bytes.
[[nodiscard]] std::uint64_t layout_in(std::span<const std::uint8_t> bytes) noexcept;

// Without a check.
//
// bytes  stored_bytes at least, aligned as Settings.
[[nodiscard]] const Settings& settings_in(std::span<const std::uint8_t> bytes) noexcept;

}  // namespace zlg::firmware
