#include "shared_memory.hpp"

#include <cerrno>
#include <system_error>

#include <sys/mman.h>
#include <unistd.h>

namespace zlg::processor {

SharedMemory::SharedMemory(std::size_t bytes, std::size_t mapped)
    : fd_{memfd_create("exchange", MFD_CLOEXEC)}, mapped_{mapped} {
    void* const made = fd_ >= 0 && ftruncate(fd_, static_cast<off_t>(bytes)) == 0
                           ? mmap(nullptr, mapped, PROT_READ | PROT_WRITE, MAP_SHARED, fd_, 0)
                           : MAP_FAILED;
    if (made == MAP_FAILED) {
        const int error = errno;
        if (fd_ >= 0) close(fd_);
        throw std::system_error{error, std::generic_category(), "shared memory"};
    }
    data_ = made;
}

SharedMemory::~SharedMemory() {
    munmap(data_, mapped_);
    close(fd_);
}

}  // namespace zlg::processor
