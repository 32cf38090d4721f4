#include "open_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include <zlg/text/inputs.hpp>
#include <zlg/text/whole_file.hpp>

namespace zlg::text {
namespace {

constexpr std::size_t block_bytes = std::size_t{1} << 16;

[[noreturn]] void fail(int error) { throw CannotRead{error == EISDIR ? "it is a folder" : std::strerror(error)}; }

}  // namespace

OpenFile::OpenFile(const std::string& path) : fd_{::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY)} {
    if (fd_ < 0) fail(errno);
    note_input(fd_);
}

OpenFile::~OpenFile() { ::close(fd_); }

bool OpenFile::append_to(std::string& text) {
    const std::size_t before = text.size();
    text.resize(before + block_bytes);
    ssize_t n = -1;
    do n = ::read(fd_, text.data() + before, block_bytes);
    while (n < 0 && errno == EINTR);
    if (n < 0) fail(errno);
    text.resize(before + static_cast<std::size_t>(n));
    return n > 0;
}

}  // namespace zlg::text
