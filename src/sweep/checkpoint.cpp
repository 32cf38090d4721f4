#include <zlg/sweep/checkpoint.hpp>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include <zlg/logs/error.hpp>
#include <zlg/sweep/row_text.hpp>
#include <zlg/text/inputs.hpp>

namespace zlg::sweep {
namespace {

constexpr std::string_view first_line = "zlg sweep checkpoint 1";

std::string head_of(const std::string& description) {
    std::string head = fmt::format("{}\n", first_line);
    for (std::size_t at = 0; at < description.size();) {
        const std::size_t end = std::min(description.find('\n', at), description.size());
        head += fmt::format("| {}\n", description.substr(at, end - at));
        at = end + 1;
    }
    return head + fmt::format("rows\t{}\n", text_checksum(head));
}

// A checkpoint as far as it is whole.
struct Content {
    Results results;
    std::size_t whole_bytes = 0;
    bool has_head = false;
};

class Reader {
public:
    Reader(const std::string& path, std::string text) : path_{path}, text_{std::move(text)} {}

    Content read() {
        Content content;
        if (!read_head(content.results.description)) return content;
        content.has_head = true;
        content.whole_bytes = at_;
        const Description description = parse(content.results.description, path_);
        for (std::string_view line; next(line); content.whole_bytes = at_) {
            const std::optional<Row> row = row_of(line, description.metrics.size());
            if (!row)
                throw logs::FormatError(
                    fmt::format("{}, line {}: is damaged; allowed is what zlg sweep wrote", path_, line_));
            add_rows(content.results.rows, {{row->gyro, *row}}, path_);
        }
        return content;
    }

private:
    // False where there is no whole line any more.
    bool next(std::string_view& line) {
        const std::size_t end = text_.find('\n', at_);
        if (end == std::string::npos) return false;
        line = std::string_view{text_}.substr(at_, end - at_);
        at_ = end + 1;
        ++line_;
        return true;
    }

    // False where it is torn: nothing but a beginning of it is there.
    bool read_head(std::string& description) {
        std::string_view line;
        const std::string expected = fmt::format("{}\n", first_line);
        if (std::string_view{expected}.starts_with(text_)) return false;
        if (!next(line) || line != first_line)
            throw logs::FormatError(fmt::format("{}: is no checkpoint of a sweep", path_));
        for (std::size_t before = at_; next(line); before = at_) {
            if (line.starts_with("| ")) {
                description += fmt::format("{}\n", line.substr(2));
                continue;
            }
            if (line == fmt::format("rows\t{}", text_checksum(std::string_view{text_}.substr(0, before)))) return true;
            throw logs::FormatError(
                fmt::format("{}, line {}: is damaged; allowed is what zlg sweep wrote", path_, line_));
        }
        return false;
    }

    const std::string& path_;
    std::string text_;
    std::size_t at_ = 0;
    std::size_t line_ = 0;
};

[[noreturn]] void fail(const char* what, const std::string& path) {
    throw logs::IoError(fmt::format("cannot {} {}: {}", what, path, std::strerror(errno)));
}

std::string whole_text(const std::string& path) {
    std::ifstream in{path, std::ios::binary};
    if (!in) fail("open", path);
    std::string text{std::istreambuf_iterator<char>{in}, {}};
    if (in.bad()) fail("read", path);
    return text;
}

// Locked, and the file that has the name: between opening and locking another program may have completed it.
int open_locked(const std::string& path) {
    const int fd = ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC | O_NONBLOCK, 0666);
    if (fd < 0) fail("create", path);
    struct stat ours {};
    struct stat named {};
    const bool is_locked = ::flock(fd, LOCK_EX | LOCK_NB) == 0;
    const int lock_error = is_locked ? 0 : errno;
    const bool is_regular = ::fstat(fd, &ours) == 0 && S_ISREG(ours.st_mode);
    const bool is_named =
        ::stat(path.c_str(), &named) == 0 && named.st_ino == ours.st_ino && named.st_dev == ours.st_dev;
    if (is_locked && is_regular && is_named) return fd;
    ::close(fd);
    if (!is_regular) throw logs::IoError(fmt::format("cannot create {}: it is no regular file", path));
    if (lock_error != 0 && lock_error != EWOULDBLOCK)
        throw logs::IoError(
            fmt::format("cannot lock {}: {}; allowed is a file system with locks", path, std::strerror(lock_error)));
    throw logs::IoError(
        fmt::format("{}: another program writes it; let it end, or name another file with --out", path));
}

}  // namespace

Checkpoint::Checkpoint(std::string path, const std::string& description) : path_{std::move(path)} {
    text::refuse_input(path_);
    fd_ = open_locked(path_);
    try {
        Content content = Reader{path_, whole_text(path_)}.read();
        if (!content.has_head) {
            begin(description);
            return;
        }
        if (const std::string what = difference(content.results.description, description); !what.empty())
            throw logs::IoError(fmt::format(
                "{} is of another sweep: it {}; name another file with --out, or use --force", path_, what));
        if (::ftruncate(fd_, static_cast<off_t>(content.whole_bytes)) != 0) fail("write", path_);
        rows_ = std::move(content.results.rows);
    } catch (...) {
        ::close(fd_);
        throw;
    }
}

Checkpoint::~Checkpoint() { ::close(fd_); }

void Checkpoint::begin(const std::string& description) {
    if (::ftruncate(fd_, 0) != 0) fail("write", path_);
    write(head_of(description));
}

void Checkpoint::append(const Row& row) { write(text_of(row) + "\n"); }

void Checkpoint::write(const std::string& text) {
    struct stat before {};
    if (::fstat(fd_, &before) != 0) fail("write", path_);
    std::string_view left{text};
    while (!left.empty()) {
        const ssize_t n = ::write(fd_, left.data(), left.size());
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) {
            const int error = errno;
            (void)!::ftruncate(fd_, before.st_size);
            errno = error;
            fail("write", path_);
        }
        left.remove_prefix(static_cast<std::size_t>(n));
    }
}

void Checkpoint::remove() { ::unlink(path_.c_str()); }

bool is_checkpoint(const std::string& path) {
    std::ifstream in{path, std::ios::binary};
    std::string line;
    return std::getline(in, line) && line == first_line;
}

Results read_checkpoint(const std::string& path) {
    Content content = Reader{path, whole_text(path)}.read();
    if (!content.has_head) throw logs::FormatError(fmt::format("{}: its description is cut off", path));
    return std::move(content.results);
}

}  // namespace zlg::sweep
