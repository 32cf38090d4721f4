#include <fcntl.h>
#include <fmt/format.h>
#include <stdio.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <zlg/logs/error.hpp>
#include <zlg/logs/table_file.hpp>

#include "file_descriptor.hpp"

namespace zlg::logs {

namespace {

// Large enough that the system call costs nothing beside the formatting.
constexpr std::size_t block_bytes = std::size_t{1} << 20;

[[noreturn]] void fail(std::string_view what, const std::string& path, int error) {
    throw IoError(fmt::format("cannot {} {}: {}", what, path, std::strerror(error)));
}

// A device or a folder must never be the target of a rename, not even with force.
void check_target(const std::string& path, bool force) {
    if (path.empty()) throw IoError("an output needs a name; this one is empty");
    const auto folder = std::filesystem::path{path}.parent_path();
    std::error_code ignored;
    if (!folder.empty() && !std::filesystem::is_directory(folder, ignored)) {
        throw IoError(fmt::format("cannot create {}: there is no folder {}", path, folder.string()));
    }
    struct stat target {};
    const bool link = ::lstat(path.c_str(), &target) == 0 && S_ISLNK(target.st_mode);
    const bool exists = ::stat(path.c_str(), &target) == 0;
    if (exists && S_ISDIR(target.st_mode)) throw IoError(fmt::format("cannot create {}: it is a folder", path));
    if (exists && !S_ISREG(target.st_mode)) throw IoError(fmt::format("cannot create {}: it is no regular file", path));
    if ((exists || link) && !force) throw IoError(fmt::format("{} exists; use --force to overwrite", path));
}

FileDescriptor create_part(const std::string& part, bool force) {
    if (force && ::unlink(part.c_str()) != 0 && errno != ENOENT) fail("remove", part, errno);
    FileDescriptor file{::open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666)};
    if (file.is_open()) return file;
    if (errno == EEXIST) {
        throw IoError(fmt::format(
            "{} exists: another program writes it, or one was interrupted; use --force to overwrite", part));
    }
    fail("create", part, errno);
}

bool same_file(int fd, const std::string& path) {
    struct stat open_file {};
    struct stat named_file {};
    return ::fstat(fd, &open_file) == 0 && ::lstat(path.c_str(), &named_file) == 0 &&
           open_file.st_dev == named_file.st_dev && open_file.st_ino == named_file.st_ino;
}

// Without force a file that appeared under the name since the start must survive. Some file systems cannot rename so.
int rename_part(const std::string& part, const std::string& path, bool force) {
    if (!force) {
        if (::renameat2(AT_FDCWD, part.c_str(), AT_FDCWD, path.c_str(), RENAME_NOREPLACE) == 0) return 0;
        if (errno != EINVAL && errno != ENOSYS) return errno;
        if (::access(path.c_str(), F_OK) == 0) return EEXIST;
    }
    return ::rename(part.c_str(), path.c_str()) == 0 ? 0 : errno;
}

}  // namespace

struct TableFile::State {
    State(std::string target, bool may_replace) : path{std::move(target)}, part{path + ".part"}, force{may_replace} {
        check_target(path, force);
        file = create_part(part, force);
        buffer.reserve(2 * block_bytes);
    }
    ~State() { discard(); }

    // Another program may have replaced PATH.part by its own with force; that one stays.
    void discard() {
        if (file.is_open() && same_file(file.get(), part)) ::unlink(part.c_str());
        file = FileDescriptor{};
    }

    // What was lost once cannot be completed: nothing appears under the name any more.
    [[noreturn]] void give_up(std::string_view what, const std::string& name, int error) {
        discard();
        fail(what, name, error);
    }

    void flush() {
        std::string_view left{buffer};
        while (!left.empty()) {
            const ssize_t n = ::write(file.get(), left.data(), left.size());
            if (n < 0 && errno == EINTR) continue;
            if (n < 0) give_up("write", part, errno);
            left.remove_prefix(static_cast<std::size_t>(n));
        }
        buffer.clear();
    }

    std::string path;
    std::string part;
    bool force;
    FileDescriptor file;
    std::string buffer;
};

TableFile::TableFile(std::string path, bool force) : state_{std::make_unique<State>(std::move(path), force)} {}
TableFile::~TableFile() = default;
TableFile::TableFile(TableFile&&) noexcept = default;
TableFile& TableFile::operator=(TableFile&&) noexcept = default;

void TableFile::append(std::string_view text) {
    State& s = *state_;
    if (!s.file.is_open()) throw IoError(fmt::format("cannot write {}: it is closed", s.part));
    s.buffer += text;
    if (s.buffer.size() >= block_bytes) s.flush();
}

void TableFile::close() {
    State& s = *state_;
    if (!s.file.is_open()) throw IoError(fmt::format("cannot close {}: it is closed", s.part));
    s.flush();
    if (!same_file(s.file.get(), s.part)) {
        s.discard();
        throw IoError(fmt::format("cannot complete {}: another program has replaced or removed {}", s.path, s.part));
    }
    if (::close(s.file.release()) != 0) {
        const int error = errno;
        ::unlink(s.part.c_str());
        fail("write", s.part, error);
    }
    if (const int error = rename_part(s.part, s.path, s.force); error != 0) {
        ::unlink(s.part.c_str());
        if (error == EEXIST) throw IoError(fmt::format("{} exists; use --force to overwrite", s.path));
        fail("create", s.path, error);
    }
}

}  // namespace zlg::logs
