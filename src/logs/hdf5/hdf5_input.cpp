#include "hdf5_input.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>
#include <zlg/logs/error.hpp>

#include "hdf5_global_heap.hpp"

namespace zlg::logs::hdf5 {

namespace {

constexpr haddr_t max_address = (haddr_t{1} << 62) - 1;

struct DriverInfo {
    int fd;
};

// What the library hands to every call of the driver; its own part comes first.
struct File {
    H5FD_t library_part;
    int fd;
    haddr_t end_of_allocation;
};

File& of(H5FD_t* file) { return *reinterpret_cast<File*>(file); }
const File& of(const H5FD_t* file) { return *reinterpret_cast<const File*>(file); }

H5FD_t* open_input(const char*, unsigned, hid_t access, haddr_t) {
    const auto* info = static_cast<const DriverInfo*>(H5Pget_driver_info(access));
    if (info == nullptr) return nullptr;
    File* file = new (std::nothrow) File{};
    if (file != nullptr) file->fd = info->fd;
    return reinterpret_cast<H5FD_t*>(file);
}

herr_t close_input(H5FD_t* file) {
    delete &of(file);
    return 0;
}

herr_t query(const H5FD_t*, unsigned long* flags) {
    *flags = H5FD_FEAT_DATA_SIEVE | H5FD_FEAT_SUPPORTS_SWMR_IO | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
    return 0;
}

haddr_t get_eoa(const H5FD_t* file, H5FD_mem_t) { return of(file).end_of_allocation; }

herr_t set_eoa(H5FD_t* file, H5FD_mem_t, haddr_t address) {
    of(file).end_of_allocation = address;
    return 0;
}

haddr_t get_eof(const H5FD_t* file, H5FD_mem_t) {
    struct stat status {};
    return ::fstat(of(file).fd, &status) == 0 ? static_cast<haddr_t>(status.st_size) : HADDR_UNDEF;
}

// Leaves the innermost remark, in the words that `last_failure` looks for.
herr_t fail_with(const char* remark) {
    H5Epush2(H5E_DEFAULT, "", "read", 0, H5E_ERR_CLS, H5E_IO, H5E_READERROR, "%s", remark);
    return -1;
}

herr_t read(H5FD_t* file, H5FD_mem_t kind, hid_t, haddr_t address, size_t size, void* buffer) try {
    if (address > max_address) return fail_with("an address that no file has");
    // The library reads a heap of texts as it reads rows.
    if (kind == H5FD_MEM_DRAW && is_damaged_heap_collection(of(file).fd, address)) {
        return fail_with("damaged texts: a size in their heap leads nowhere");
    }
    char* bytes = static_cast<char*>(buffer);
    while (size > 0) {
        const ssize_t n = ::pread(of(file).fd, bytes, size, static_cast<off_t>(address));
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return fail_with(fmt::format("error message = '{}'", std::strerror(errno)).c_str());
        if (n == 0) break;
        bytes += n;
        address += static_cast<haddr_t>(n);
        size -= static_cast<std::size_t>(n);
    }
    if (size > 0 && kind == H5FD_MEM_DRAW) return fail_with("lies behind the end of the file, which was cut off");
    std::memset(bytes, 0, size);
    return 0;
} catch (...) {
    return -1;
}

herr_t refuse_to_write(H5FD_t*, H5FD_mem_t, hid_t, haddr_t, size_t, const void*) { return -1; }

hid_t register_driver() {
    static H5FD_class_t driver{};
    driver.name = "zlg log, to be read";
    driver.maxaddr = max_address;
    driver.fc_degree = H5F_CLOSE_WEAK;
    driver.fapl_size = sizeof(DriverInfo);
    driver.open = &open_input;
    driver.close = &close_input;
    driver.query = &query;
    driver.get_eoa = &get_eoa;
    driver.set_eoa = &set_eoa;
    driver.get_eof = &get_eof;
    driver.read = &read;
    driver.write = &refuse_to_write;
    constexpr H5FD_mem_t kinds[H5FD_MEM_NTYPES] = H5FD_FLMAP_DICHOTOMY;
    std::ranges::copy(kinds, driver.fl_map);
    return H5FDregister(&driver);
}

}  // namespace

Handle access_to_read(int fd) {
    static const hid_t driver = register_driver();
    Handle access{H5Pcreate(H5P_FILE_ACCESS), &H5Pclose};
    const DriverInfo info{fd};
    if (driver < 0 || H5Pset_driver(access.get(), driver, &info) < 0) {
        throw IoError("the HDF5 library refuses the driver of a log: " + last_failure().reason);
    }
    return access;
}

}  // namespace zlg::logs::hdf5
