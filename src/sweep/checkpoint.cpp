#include <zlg/sweep/checkpoint.hpp>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <iterator>
#include <span>
#include <string_view>

#include <fmt/format.h>

#include <zlg/logs/error.hpp>
#include <zlg/text/inputs.hpp>
#include <zlg/wire/crc.hpp>

namespace zlg::sweep {
namespace {

constexpr std::string_view first_line = "zlg sweep checkpoint 1";
constexpr std::size_t max_fields = 100'000;

std::string checksum(std::string_view text) {
    return fmt::format("{:08x}", wire::crc32c({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}));
}

std::string head_of(const std::string& description) {
    std::string head = fmt::format("{}\n", first_line);
    for (std::size_t at = 0; at < description.size();) {
        const std::size_t end = std::min(description.find('\n', at), description.size());
        head += fmt::format("| {}\n", description.substr(at, end - at));
        at = end + 1;
    }
    return head + fmt::format("rows\t{}\n", checksum(head));
}

// gyro, status, fingerprint, reason, metrics, checksum. Control characters in a reason are escaped already.
std::string line_of(const Row& row) {
    std::string line =
        fmt::format("{}\t{}\t{}\t{}", row.gyro, static_cast<std::int64_t>(row.status), row.fingerprint, row.reason);
    for (const double value : row.metrics) line += fmt::format("\t{}", value);
    return line + fmt::format("\t{}\n", checksum(line));
}

std::vector<std::string_view> fields_of(std::string_view line) {
    std::vector<std::string_view> fields;
    for (std::size_t at = 0; fields.size() < max_fields;) {
        const std::size_t end = line.find('\t', at);
        fields.push_back(line.substr(at, end - at));
        if (end == std::string_view::npos) break;
        at = end + 1;
    }
    return fields;
}

template <class T>
bool read_number(std::string_view text, T& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && end == text.data() + text.size();
}

bool read_row(std::string_view line, std::size_t n_metrics, Row& row) {
    const std::size_t last_tab = line.rfind('\t');
    if (last_tab == std::string_view::npos || line.substr(last_tab + 1) != checksum(line.substr(0, last_tab)))
        return false;
    const std::vector<std::string_view> fields = fields_of(line.substr(0, last_tab));
    std::int64_t status = 0;
    if (fields.size() != 4 + n_metrics || !read_number(fields[0], row.gyro) || !read_number(fields[1], status))
        return false;
    row.status = static_cast<Status>(status);
    row.fingerprint = fields[2];
    row.reason = fields[3];
    row.metrics.assign(n_metrics, 0.0);
    for (std::size_t k = 0; k < n_metrics; ++k)
        if (!read_number(fields[4 + k], row.metrics[k])) return false;
    return true;
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
            Row row;
            if (!read_row(line, description.metrics.size(), row) || row.gyro < 0 || row.gyro >= max_gyros)
                throw logs::FormatError(
                    fmt::format("{}, line {}: is damaged; allowed is what zlg sweep wrote", path_, line_));
            add_rows(content.results.rows, {{row.gyro, row}}, path_);
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
            if (line == fmt::format("rows\t{}", checksum(std::string_view{text_}.substr(0, before)))) return true;
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
    const bool is_regular = ::fstat(fd, &ours) == 0 && S_ISREG(ours.st_mode);
    const bool is_named =
        ::stat(path.c_str(), &named) == 0 && named.st_ino == ours.st_ino && named.st_dev == ours.st_dev;
    if (is_locked && is_regular && is_named) return fd;
    ::close(fd);
    if (!is_regular) throw logs::IoError(fmt::format("cannot create {}: it is no regular file", path));
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

void Checkpoint::append(const Row& row) { write(line_of(row)); }

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
