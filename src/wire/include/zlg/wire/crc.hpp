#pragma once
// CRC-32C (Castagnoli), as in iSCSI and in storage: reflected, polynomial 0x1EDC6F41, start and final exclusive-or ~0.

#include <cstdint>
#include <span>

namespace zlg::wire {

// Up to 5 bits wrong in a message of up to 655 bytes are always seen; of all other damage one part in 2^32 passes.
//
// The check value, of the nine bytes "123456789", is 0xE3069283.
[[nodiscard]] std::uint32_t crc32c(std::span<const std::uint8_t> bytes) noexcept;

}  // namespace zlg::wire
