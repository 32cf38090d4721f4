#include <fcntl.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include <zlg/logs/byte_source.hpp>
#include <zlg/logs/error.hpp>

#include "file_descriptor.hpp"

namespace zlg::logs {
namespace {

// The system knows the speeds by their numbers, and by its own: below the least, and from 4096 on.
void set_speed(termios& settings, int baud) {
    constexpr int least = 50;
    const bool is_own_number = baud >= 4096 && baud < 4112;
    if (baud < least || is_own_number || ::cfsetspeed(&settings, static_cast<speed_t>(baud)) != 0)
        throw SourceError{
            fmt::format("baud {}: allowed are 9600, 115200, 921600 and the other speeds of serial lines", baud)};
}

// Bytes as they come: no line editing, no flow control, no signals.
void make_raw(int fd, const std::string& name, int baud) {
    termios settings{};
    if (::tcgetattr(fd, &settings) != 0) fail_io("set up", name, errno);
    ::cfmakeraw(&settings);
    settings.c_cflag |= static_cast<tcflag_t>(CLOCAL | CREAD);
    settings.c_cflag &= ~static_cast<tcflag_t>(CSTOPB | CRTSCTS);
    settings.c_cc[VMIN] = 1;
    settings.c_cc[VTIME] = 0;
    set_speed(settings, baud);
    if (::tcsetattr(fd, TCSANOW, &settings) != 0) fail_io("set up", name, errno);
}

FileDescriptor open_path(const std::string& path, int baud, bool writes) {
    // Not to wait for the other end of a pipe, or for the carrier of a modem.
    const int access = writes ? O_RDWR : O_RDONLY;
    FileDescriptor file{::open(path.c_str(), access | O_NONBLOCK | O_NOCTTY | O_CLOEXEC)};
    if (!file.is_open()) fail_io("open", path, errno);
    struct stat what {};
    if (::fstat(file.get(), &what) == 0 && S_ISDIR(what.st_mode)) fail_io("read", path, EISDIR);
    if (writes && !S_ISCHR(what.st_mode))
        throw SourceError{fmt::format("{}: allowed is a serial device, tcp:HOST:PORT or unix:PATH", path)};
    if (::isatty(file.get()) != 0) make_raw(file.get(), path, baud);
    return file;
}

struct TcpAddress {
    std::string host;
    std::string port;
};

// HOST may be an IPv6 address, in brackets or without.
TcpAddress tcp_address(const std::string& name) {
    const std::string address = name.substr(4);
    const std::size_t colon = std::min(address.rfind(':'), address.size());
    TcpAddress parts{.host = address.substr(0, colon), .port = address.substr(std::min(colon + 1, address.size()))};
    if (parts.host.starts_with('[') && parts.host.ends_with(']')) parts.host = parts.host.substr(1, colon - 2);
    int port = 0;
    const char* const end = parts.port.data() + parts.port.size();
    const auto [read_to, error] = std::from_chars(parts.port.data(), end, port);
    if (parts.host.empty() || error != std::errc{} || read_to != end || port < 1 || port > 65535)
        throw SourceError{fmt::format("{}: allowed is tcp:HOST:PORT, PORT in 1..65535", name)};
    return parts;
}

FileDescriptor connect_tcp(const std::string& name) {
    const TcpAddress address = tcp_address(name);
    addrinfo wanted{};
    wanted.ai_socktype = SOCK_STREAM;
    addrinfo* found = nullptr;
    const int unresolved = ::getaddrinfo(address.host.c_str(), address.port.c_str(), &wanted, &found);
    if (unresolved != 0) throw IoError{fmt::format("cannot connect to {}: {}", name, ::gai_strerror(unresolved))};
    const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> addresses{found, ::freeaddrinfo};
    int error = 0;
    for (const addrinfo* a = found; a != nullptr; a = a->ai_next) {
        FileDescriptor socket{::socket(a->ai_family, a->ai_socktype | SOCK_CLOEXEC, a->ai_protocol)};
        if (socket.is_open() && ::connect(socket.get(), a->ai_addr, a->ai_addrlen) == 0) return socket;
        error = errno;
    }
    fail_io("connect to", name, error);
}

FileDescriptor connect_unix(const std::string& name) {
    const std::string path = name.substr(5);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    if (path.empty() || path.size() >= sizeof address.sun_path)
        throw SourceError{
            fmt::format("{}: allowed is unix:PATH, a path of up to {} bytes", name, sizeof address.sun_path - 1)};
    std::memcpy(address.sun_path, path.c_str(), path.size() + 1);
    FileDescriptor socket{::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)};
    if (socket.is_open() && ::connect(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0)
        return socket;
    fail_io("connect to", name, errno);
}

FileDescriptor opened(const std::string& source, int baud, bool writes) {
    termios any{};
    set_speed(any, baud);
    if (source == "-" && !writes) return FileDescriptor{STDIN_FILENO};
    if (source.starts_with("tcp:")) return connect_tcp(source);
    if (source.starts_with("unix:")) return connect_unix(source);
    return open_path(source, baud, writes);
}

}  // namespace

ByteSource::ByteSource(const std::string& source, int baud, Access access)
    : name_{source == "-" ? "standard input" : source},
      fd_{opened(source, baud, access == Access::both).release()},
      owned_{source != "-"} {}

ByteSource::~ByteSource() {
    if (owned_) ::close(fd_);
}

ByteSource::Read ByteSource::read(std::span<std::uint8_t> buffer, std::size_t& n, int patience_ms) {
    pollfd ready{.fd = fd_, .events = POLLIN, .revents = 0};
    const int polled = ::poll(&ready, 1, patience_ms);
    if (polled < 0 && errno != EINTR) fail_io("read", name_, errno);
    if (polled <= 0) return Read::nothing;
    const ssize_t got = ::read(fd_, buffer.data(), buffer.size());
    if (got > 0) {
        n = static_cast<std::size_t>(got);
        return Read::bytes;
    }
    if (got == 0) return Read::end;
    if (errno == EINTR || errno == EAGAIN) return Read::nothing;
    // The other end of a terminal or a socket is gone.
    const int error = errno;
    if ((error == EIO && ::isatty(fd_) != 0) || error == ECONNRESET) return Read::end;
    fail_io("read", name_, error);
}

void ByteSource::write(std::span<const std::uint8_t> bytes) {
    constexpr int patience_ms = 2000;
    while (!bytes.empty()) {
        pollfd ready{.fd = fd_, .events = POLLOUT, .revents = 0};
        if (::poll(&ready, 1, patience_ms) == 0) fail_io("write to", name_, ETIMEDOUT);
        const ssize_t put = ::write(fd_, bytes.data(), bytes.size());
        if (put > 0) bytes = bytes.subspan(static_cast<std::size_t>(put));
        if (put < 0 && errno != EINTR && errno != EAGAIN) fail_io("write to", name_, errno);
    }
}

}  // namespace zlg::logs
