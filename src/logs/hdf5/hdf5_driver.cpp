#include "hdf5_driver.hpp"

#include <unistd.h>

#include <cerrno>

namespace zlg::logs::hdf5 {

ssize_t read_at(int fd, haddr_t address, size_t size, void* buffer) {
    std::size_t done = 0;
    while (done < size) {
        const ssize_t n =
            ::pread(fd, static_cast<char*>(buffer) + done, size - done, static_cast<off_t>(address + done));
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return -1;
        if (n == 0) break;
        done += static_cast<std::size_t>(n);
    }
    return static_cast<ssize_t>(done);
}

}  // namespace zlg::logs::hdf5
