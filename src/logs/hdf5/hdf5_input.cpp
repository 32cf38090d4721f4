#include "hdf5_input.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>

#include "hdf5_driver.hpp"
#include "hdf5_global_heap.hpp"

namespace zlg::logs::hdf5 {

namespace {

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
