// Settings in the flash, with what tells whether they are whole and of this program.

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include <zlg/firmware/exchange.hpp>
#include <zlg/firmware/port.hpp>
#include <zlg/wire/crc.hpp>

namespace zlg::firmware::port {
namespace {

struct Stored {
    std::uint64_t layout;
    Settings settings;
    std::uint32_t crc;  // of the settings, as they lie in memory
};
static_assert(std::is_trivially_copyable_v<Stored>);

// Bytes, for no constructor may run here: it would put the defaults over what is stored.
alignas(Stored) [[gnu::section(".stored")]] constinit std::array<std::byte, sizeof(Stored)> memory{};

Stored& flash() noexcept { return *reinterpret_cast<Stored*>(memory.data()); }

std::uint32_t crc_of(const Settings& settings) noexcept {
    return wire::crc32c({reinterpret_cast<const std::uint8_t*>(&settings), sizeof settings});
}

}  // namespace

// It takes longer than a half-period: the interrupts go on, and the memory protection lets this part of the flash be
// written.
void store(const Settings& settings) noexcept {
    Stored& to = flash();
    std::memcpy(&to.settings, &settings, sizeof settings);
    to.crc = crc_of(settings);
    to.layout = layout();
}

const Settings* stored() noexcept {
    const Stored& from = flash();
    const bool is_whole = from.layout == layout() && from.crc == crc_of(from.settings);
    return is_whole && check(from.settings) == SettingsFault{} ? &from.settings : nullptr;
}

}  // namespace zlg::firmware::port
