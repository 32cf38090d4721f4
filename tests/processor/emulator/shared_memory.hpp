#pragma once
// Memory that another program can map by a file descriptor: it has no name and leaves nothing behind.

#include <cstddef>

namespace zlg::processor {

class SharedMemory {
public:
    // bytes   that the other program sees.
    // mapped  bytes of them, from the first, that this program sees.
    //
    // errors  std::system_error.
    SharedMemory(std::size_t bytes, std::size_t mapped);
    ~SharedMemory();
    SharedMemory(const SharedMemory&) = delete;
    SharedMemory& operator=(const SharedMemory&) = delete;

    [[nodiscard]] int fd() const { return fd_; }
    [[nodiscard]] void* data() const { return data_; }  // zeros at first

private:
    int fd_ = -1;
    std::size_t mapped_;
    void* data_ = nullptr;
};

}  // namespace zlg::processor
