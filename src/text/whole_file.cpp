#include <zlg/text/whole_file.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include <fmt/format.h>

#include <zlg/text/inputs.hpp>

namespace zlg::text {
namespace {

constexpr std::size_t block_bytes = std::size_t{1} << 16;

[[noreturn]] void fail(int error) { throw CannotRead{error == EISDIR ? "it is a folder" : std::strerror(error)}; }

// A file for reading, noted as an input; closed however reading ends.
class OpenFile {
public:
    explicit OpenFile(const std::string& path) : fd_{::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY)} {
        if (fd_ < 0) fail(errno);
        note_input(fd_);
    }
    ~OpenFile() { ::close(fd_); }
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;

    // Appends what comes next, a block at most; false at the end.
    bool append_to(std::string& text) {
        const std::size_t before = text.size();
        text.resize(before + block_bytes);
        ssize_t n = -1;
        do n = ::read(fd_, text.data() + before, block_bytes);
        while (n < 0 && errno == EINTR);
        if (n < 0) fail(errno);
        text.resize(before + static_cast<std::size_t>(n));
        return n > 0;
    }

private:
    int fd_;
};

}  // namespace

std::string read_whole(const std::string& path, std::size_t max_bytes) {
    OpenFile file{path};
    std::string text;
    while (file.append_to(text))
        if (text.size() > max_bytes)
            throw TooLong{fmt::format("{}: longer than {} bytes, which is the most allowed", path, max_bytes)};
    return text;
}

}  // namespace zlg::text
