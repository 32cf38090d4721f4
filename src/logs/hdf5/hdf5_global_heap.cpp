#include "hdf5_global_heap.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "hdf5_driver.hpp"

namespace zlg::logs::hdf5 {

namespace {

// Of a collection and of each of its objects: 16 bytes, of which the last 8 are the size.
constexpr std::size_t header_bytes = 16;
constexpr std::size_t size_at = 8;
constexpr std::size_t max_collection_bytes = std::size_t{64} << 20;

bool read_all(int fd, std::uint64_t address, std::span<unsigned char> bytes) {
    return read_at(fd, address, bytes.size(), bytes.data()) == static_cast<ssize_t>(bytes.size());
}

std::uint64_t little_endian(std::span<const unsigned char> bytes) {
    std::uint64_t value = 0;
    for (std::size_t i = bytes.size(); i > 0; --i) value = value << 8 | bytes[i - 1];
    return value;
}

// Bytes from the header of an object to the next one: those of the free space count from its header, those of an object
// from behind it and up to a multiple of eight. 0 for a size that leads nowhere.
std::uint64_t step_over(std::span<const unsigned char> header) {
    const std::uint64_t index = little_endian(header.first(2));
    const std::uint64_t size = little_endian(header.subspan(size_at, 8));
    if (index == 0) return size;
    constexpr std::uint64_t alignment = 8;
    if (size > max_collection_bytes) return 0;
    return header_bytes + (size + alignment - 1) / alignment * alignment;
}

}  // namespace

bool is_damaged_heap_collection(int fd, std::uint64_t address) {
    std::array<unsigned char, header_bytes> head{};
    constexpr std::string_view signature{"GCOL\1\0\0\0", 8};
    if (!read_all(fd, address, head) || !std::equal(signature.begin(), signature.end(), head.begin())) return false;
    const std::uint64_t size = little_endian(std::span{head}.subspan(size_at, 8));
    if (size < header_bytes || size > max_collection_bytes) return true;
    std::vector<unsigned char> collection(static_cast<std::size_t>(size));
    if (!read_all(fd, address, collection)) return true;

    // Less than a header at the end is a rest that belongs to nobody.
    std::span<const unsigned char> rest = std::span{collection}.subspan(header_bytes);
    while (rest.size() >= header_bytes) {
        const std::uint64_t step = step_over(rest);
        if (step == 0 || step > rest.size()) return true;
        rest = rest.subspan(static_cast<std::size_t>(step));
    }
    return false;
}

}  // namespace zlg::logs::hdf5
