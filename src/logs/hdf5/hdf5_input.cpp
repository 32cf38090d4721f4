// How the HDF5 library reads a log: see hdf5_driver.hpp.
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <vector>

#include "hdf5_driver.hpp"

namespace zlg::logs::hdf5 {

namespace {

// Where HDF5 keeps texts of their own length: collections of objects, one behind the other.
//
// The library walks through a collection by the sizes that it finds in it and relies on them: with a damaged size it
// walks for ever. Collections have no checksum, so they are walked here first.

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

// Does a collection begin at byte `address` of the file whose own size, or the size of one of its objects, leads behind
// its end or nowhere? False where none begins.
//
// Source: HDF5 File Format Specification, version 3.0, section III.E.
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

// The subject is the descriptor of the open file.
using File = DriverFile<int>;

herr_t query(const H5FD_t*, unsigned long* flags) {
    *flags = H5FD_FEAT_DATA_SIEVE | H5FD_FEAT_SUPPORTS_SWMR_IO | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
    return 0;
}

haddr_t get_eof(const H5FD_t* file, H5FD_mem_t) {
    struct stat status {};
    return ::fstat(File::of(file).subject, &status) == 0 ? static_cast<haddr_t>(status.st_size) : HADDR_UNDEF;
}

// Leaves the innermost remark, in the words that `last_failure` looks for.
herr_t fail_with(const char* remark) {
    H5Epush2(H5E_DEFAULT, "", "read", 0, H5E_ERR_CLS, H5E_IO, H5E_READERROR, "%s", remark);
    return -1;
}

herr_t read(H5FD_t* file, H5FD_mem_t kind, hid_t, haddr_t address, size_t size, void* buffer) try {
    if (address > max_address) return fail_with("an address that no file has");
    const int fd = File::of(file).subject;
    // The library reads a heap of texts as it reads rows.
    if (kind == H5FD_MEM_DRAW && is_damaged_heap_collection(fd, address)) {
        return fail_with("damaged texts: a size in their heap leads nowhere");
    }
    const ssize_t n = read_at(fd, address, size, buffer);
    if (n < 0) return fail_with(fmt::format("error message = '{}'", std::strerror(errno)).c_str());
    const std::size_t missing = size - static_cast<std::size_t>(n);
    if (missing > 0 && kind == H5FD_MEM_DRAW) return fail_with("lies behind the end of the file, which was cut off");
    std::memset(static_cast<char*>(buffer) + n, 0, missing);
    return 0;
} catch (...) {
    return -1;
}

herr_t refuse_to_write(H5FD_t*, H5FD_mem_t, hid_t, haddr_t, size_t, const void*) { return -1; }

hid_t register_driver() {
    H5FD_class_t driver = driver_of<int>("zlg log, to be read", H5F_CLOSE_WEAK);
    driver.query = &query;
    driver.get_eof = &get_eof;
    driver.read = &read;
    driver.write = &refuse_to_write;
    return H5FDregister(&driver);
}

}  // namespace

Handle access_to_read(int fd) {
    static const hid_t driver = register_driver();
    return access_of(driver, fd);
}

}  // namespace zlg::logs::hdf5
