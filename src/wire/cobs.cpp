#include <zlg/wire/cobs.hpp>

namespace zlg::wire {
namespace {

// A block is its length and up to 254 bytes; one that is shorter stands for a zero behind them.
constexpr std::uint8_t full_block = 0xFF;

}  // namespace

std::size_t stuff(std::span<const std::uint8_t> bytes, std::span<std::uint8_t> out) noexcept {
    std::size_t block = 0;
    std::size_t at = 1;
    std::uint8_t length = 1;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        if (bytes[i] != 0) {
            out[at++] = bytes[i];
            ++length;
        }
        const bool full = length == full_block && i + 1 < bytes.size();
        if (bytes[i] != 0 && !full) continue;
        out[block] = length;
        block = at++;
        length = 1;
    }
    out[block] = length;
    return at;
}

Unstuffed unstuff(std::span<std::uint8_t> bytes) noexcept {
    std::size_t from = 0;
    std::size_t to = 0;
    while (from < bytes.size()) {
        const std::size_t length = bytes[from++];
        if (length == 0 || from + length - 1 > bytes.size()) return {};
        for (std::size_t k = 1; k < length; ++k) {
            if (bytes[from] == 0) return {};
            bytes[to++] = bytes[from++];
        }
        if (length != full_block && from < bytes.size()) bytes[to++] = 0;
    }
    return {.good = to > 0, .size = to};
}

}  // namespace zlg::wire
