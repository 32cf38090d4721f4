#pragma once
// How a checksum is written.

#include <cstdint>
#include <string>

namespace zlg::acceptance {

[[nodiscard]] std::string hex(std::uint64_t checksum);

}  // namespace zlg::acceptance
