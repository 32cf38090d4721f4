#include <zlg/sweep/checkpoint.hpp>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include <zlg/logs/error.hpp>
#include <zlg/sweep/row_text.hpp>
#include <zlg/text/inputs.hpp>

namespace zlg::sweep {
namespace {

constexpr std::string_view first_line = "zlg sweep checkpoint 1";

// More than a line of a description of 1 MiB, or of a row, can have.
constexpr std::size_t max_line_bytes = std::size_t{1} << 24;

std::string head_of(const std::string& description) {
    std::string head = fmt::format("{}\n", first_line);
    for (std::size_t at = 0; at < description.size();) {
        const std::size_t end = std::min(description.find('\n', at), description.size());
        head += fmt::format("| {}\n", description.substr(at, end - at));
        at = end + 1;
    }
    return head + fmt::format("rows\t{}\n", text_checksum(head));
}

[[noreturn]] void fail(const char* what, const std::string& path) {
    throw logs::IoError(fmt::format("cannot {} {}: {}", what, path, std::strerror(errno)));
}

// A checkpoint as far as it is whole.
struct Content {
    Results results;
    std::size_t whole_bytes = 0;
    bool has_head = false;
};

class Reader {
public:
    explicit Reader(const std::string& path) : path_{path}, in_{path, std::ios::binary} {
        if (!in_) fail("open", path_);
    }

    Content read() {
        Content content;
        if (!read_head(content.results.description)) return content;
        content.has_head = true;
        content.whole_bytes = at_;
        const Description description = recorded_description(content.results.description, path_);
        for (; next(); content.whole_bytes = at_) {
            const std::optional<Row> row = row_of(line_, description.metrics.size());
            if (!row) fail_damaged();
            add_rows(content.results.rows, {{row->gyro, *row}}, path_);
        }
        return content;
    }

private:
    // The next line, with which `at_` goes on; false where no whole one is left: `line_` is what is there.
    bool next() {
        ++n_lines_;
        line_.clear();
        constexpr int end = std::ifstream::traits_type::eof();
        for (int c = in_.get(); c != '\n'; c = in_.get()) {
            if (in_.bad()) fail("read", path_);
            if (c == end) return false;
            if (line_.size() == max_line_bytes) fail_damaged();
            line_ += static_cast<char>(c);
        }
        at_ += line_.size() + 1;
        return true;
    }

    // False where it is torn: nothing but a beginning of it is there.
    bool read_head(std::string& description) {
        const bool is_whole = next();
        if (!is_whole && first_line.starts_with(line_)) return false;
        if (!is_whole || line_ != first_line)
            throw logs::FormatError(fmt::format("{}: is no checkpoint of a sweep", path_));
        std::string head = line_ + '\n';
        for (; next(); head += line_ + '\n') {
            if (line_ == fmt::format("rows\t{}", text_checksum(head))) return true;
            if (!line_.starts_with("| ") || head.size() > max_line_bytes) fail_damaged();
            description += fmt::format("{}\n", std::string_view{line_}.substr(2));
        }
        return false;
    }

    [[noreturn]] void fail_damaged() const {
        throw logs::FormatError(
            fmt::format("{}, line {}: is damaged; allowed is what zlg sweep wrote", path_, n_lines_));
    }

    const std::string& path_;
    std::ifstream in_;
    std::string line_;
    std::size_t n_lines_ = 0;
    std::size_t at_ = 0;  // behind the last whole line
};

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
    struct stat before {};
    const bool holds_nothing = ::fstat(fd_, &before) == 0 && before.st_size == 0;
    try {
        Content content = Reader{path_}.read();
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
        // One that was made here, or begun by a program that did not get further.
        if (holds_nothing) remove();
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
    std::string line(first_line.size() + 1, '\0');
    return in.read(line.data(), static_cast<std::streamsize>(line.size())) && line == fmt::format("{}\n", first_line);
}

Results read_checkpoint(const std::string& path) {
    Content content = Reader{path}.read();
    if (!content.has_head) throw logs::FormatError(fmt::format("{}: its description is cut off", path));
    return std::move(content.results);
}

}  // namespace zlg::sweep
