#include <zlg/firmware/stored.hpp>

#include <array>
#include <cstring>

#include <zlg/firmware/exchange.hpp>
#include <zlg/wire/crc.hpp>

namespace zlg::firmware {
namespace {

constexpr std::array<std::uint8_t, 8> kind{'z', 'l', 'g', '-', 's', 'e', 't', '1'};
constexpr std::size_t crc_bytes = sizeof(std::uint32_t);

template <class Number> Number number_at(std::span<const std::uint8_t> bytes, std::size_t at) noexcept {
    Number number{};
    std::memcpy(&number, bytes.data() + at, sizeof number);
    return number;
}

bool is_of_this_program(std::span<const std::uint8_t> bytes) noexcept {
    return bytes.size() == stored_bytes && layout_in(bytes) == layout();
}

}  // namespace

void put_stored(const Settings& settings, std::span<std::uint8_t, stored_bytes> to) noexcept {
    const std::uint64_t of_this_program = layout();
    std::memcpy(to.data(), kind.data(), kind.size());
    std::memcpy(to.data() + kind.size(), &of_this_program, sizeof of_this_program);
    std::memcpy(to.data() + stored_head_bytes, &settings, sizeof settings);
#if __has_builtin(__builtin_clear_padding)
    __builtin_clear_padding(reinterpret_cast<Settings*>(to.data() + stored_head_bytes));
#endif
    std::memset(to.data() + stored_head_bytes + sizeof settings, 0, crc_bytes);
    const std::uint32_t crc = wire::crc32c(to.first<stored_bytes - crc_bytes>());
    std::memcpy(to.data() + stored_bytes - crc_bytes, &crc, crc_bytes);
}

std::uint32_t settings_crc(const Settings& settings) noexcept {
    return wire::crc32c({reinterpret_cast<const std::uint8_t*>(&settings), sizeof settings});
}

StoredFault fault_of(std::span<const std::uint8_t> bytes) noexcept {
    if (bytes.size() < kind.size() || std::memcmp(bytes.data(), kind.data(), kind.size()) != 0)
        return StoredFault::other_kind;
    if (bytes.size() < stored_head_bytes + crc_bytes) return StoredFault::damaged;
    const std::size_t covered = bytes.size() - crc_bytes;
    if (wire::crc32c(bytes.first(covered)) != number_at<std::uint32_t>(bytes, covered)) return StoredFault::damaged;
    if (!is_of_this_program(bytes)) return StoredFault::other_program;
    return check(settings_in(bytes)) == SettingsFault{} ? StoredFault::none : StoredFault::refused;
}

std::uint64_t layout_in(std::span<const std::uint8_t> bytes) noexcept {
    return bytes.size() < stored_head_bytes ? 0 : number_at<std::uint64_t>(bytes, kind.size());
}

const Settings& settings_in(std::span<const std::uint8_t> bytes) noexcept {
    return *reinterpret_cast<const Settings*>(bytes.data() + stored_head_bytes);
}

}  // namespace zlg::firmware
