// Bits and uniform numbers of an address.

#include <zlg/chance/address.hpp>

#include "counter.hpp"

namespace zlg::chance {

std::uint64_t bits(const Address& address, std::uint32_t index) noexcept {
    return philox(counter_of(address, of_bits, index / 2), address.seed)[index % 2];
}

double uniform(const Address& address, std::uint32_t index) noexcept {
    return static_cast<double>(bits(address, index) >> 11) * 0x1p-53;
}

}  // namespace zlg::chance
