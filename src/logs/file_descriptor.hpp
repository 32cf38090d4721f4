#pragma once
// An open file that closes itself, and what is done with one.

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <zlg/logs/error.hpp>

namespace zlg::logs {

class FileDescriptor {
public:
    FileDescriptor() = default;
    explicit FileDescriptor(int fd) : fd_{fd} {}
    ~FileDescriptor() {
        if (fd_ >= 0) ::close(fd_);
    }
    FileDescriptor(FileDescriptor&& other) noexcept : fd_{std::exchange(other.fd_, -1)} {}
    FileDescriptor& operator=(FileDescriptor&& other) noexcept {
        std::swap(fd_, other.fd_);
        return *this;
    }

    [[nodiscard]] int get() const { return fd_; }
    [[nodiscard]] bool is_open() const { return fd_ >= 0; }

    // Hands the number over to a caller who wants to see what closing says.
    [[nodiscard]] int release() { return std::exchange(fd_, -1); }

private:
    int fd_ = -1;
};

// errors  IoError: `cannot WHAT PATH: ` and what the system says of `error`.
[[noreturn]] inline void fail_io(const char* what, const std::string& path, int error) {
    throw IoError(fmt::format("cannot {} {}: {}", what, path, std::strerror(error)));
}

// errors  IoError: no such file, no permission.
inline FileDescriptor open_to_read(const std::string& path) {
    FileDescriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC)};
    if (!file.is_open()) fail_io("open", path, errno);
    return file;
}

// Reads up to `size` bytes; the number of those before the end of the file, or -1.
inline ssize_t read_at(int fd, std::size_t at, std::size_t size, void* to) {
    std::size_t done = 0;
    while (done < size) {
        const ssize_t n = ::pread(fd, static_cast<char*>(to) + done, size - done, static_cast<off_t>(at + done));
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return -1;
        if (n == 0) break;
        done += static_cast<std::size_t>(n);
    }
    return static_cast<ssize_t>(done);
}

struct Written {
    std::size_t n = 0;  // bytes
    int error = 0;      // the errno of what failed behind them; 0: nothing has
};

inline Written write_all(int fd, std::string_view bytes, std::size_t at) {
    Written done;
    while (done.n < bytes.size() && done.error == 0) {
        const ssize_t n = ::pwrite(fd, bytes.data() + done.n, bytes.size() - done.n, static_cast<off_t>(at + done.n));
        if (n > 0)
            done.n += static_cast<std::size_t>(n);
        else if (n == 0 || errno != EINTR)
            done.error = n < 0 ? errno : ENOSPC;
    }
    return done;
}

}  // namespace zlg::logs
