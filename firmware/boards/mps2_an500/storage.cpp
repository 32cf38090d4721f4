// Settings in the flash: those that the gyro starts with, and beside them those that come over the line.
//
// Plain writes, as the flash of this machine takes them. They take longer than a half-period: the interrupts go on, and
// the memory protection lets this part of the flash be written.

#include <algorithm>
#include <array>

#include <zlg/firmware/port.hpp>
#include <zlg/firmware/stored.hpp>

namespace zlg::firmware::port {
namespace {

constexpr std::size_t place_bytes = 8192;
static_assert(stored_bytes <= place_bytes);

// Bytes, for no constructor may run here: it would put the defaults over what is stored.
alignas(Settings) [[gnu::section(".stored")]] constinit std::array<std::uint8_t, 2 * place_bytes> memory{};

std::span<std::uint8_t> in_force() noexcept { return std::span{memory}.first(stored_bytes); }

}  // namespace

void store(const Settings& settings) noexcept { put_stored(settings, in_force().first<stored_bytes>()); }

const Settings* stored() noexcept {
    return fault_of(in_force()) == StoredFault::none ? &settings_in(in_force()) : nullptr;
}

bool stage(std::size_t offset, std::span<const std::uint8_t> bytes) noexcept {
    if (offset > place_bytes || bytes.size() > place_bytes - offset) return false;
    std::copy(bytes.begin(), bytes.end(), memory.begin() + place_bytes + offset);
    return true;
}

std::span<const std::uint8_t> staged() noexcept { return std::span{memory}.last(place_bytes); }

}  // namespace zlg::firmware::port
