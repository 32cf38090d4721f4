#include "bell.hpp"

#include <array>
#include <cerrno>
#include <system_error>

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace zlg::processor {

Bell::Bell() {
    std::array<int, 2> ends{-1, -1};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
        throw std::system_error{errno, std::generic_category(), "a pair of sockets"};
    fd_ = ends[0];
    other_fd_ = ends[1];
}

Bell::~Bell() {
    give_away();
    ::close(fd_);
}

void Bell::give_away() {
    if (other_fd_ >= 0) ::close(other_fd_);
    other_fd_ = -1;
}

void Bell::ring() const {
    const char byte = 1;
    // Where there is no room, it has been rung often enough.
    (void)!::send(fd_, &byte, 1, MSG_DONTWAIT | MSG_NOSIGNAL);
}

bool Bell::wait(int ms) const {
    pollfd heard{.fd = fd_, .events = POLLIN, .revents = 0};
    if (::poll(&heard, 1, ms) <= 0) return false;
    std::array<char, 64> bytes{};
    return ::recv(fd_, bytes.data(), bytes.size(), MSG_DONTWAIT) > 0;
}

}  // namespace zlg::processor
