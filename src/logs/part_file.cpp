#include "part_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdio.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <zlg/logs/error.hpp>
#include <zlg/logs/unfinished.hpp>
#include <zlg/text/inputs.hpp>

namespace zlg::logs {

namespace {

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
    if (force && ::unlink(part.c_str()) != 0 && errno != ENOENT) fail_io("remove", part, errno);
    FileDescriptor file{::open(part.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666)};
    if (file.is_open()) return file;
    if (errno == EEXIST) {
        throw IoError(fmt::format(
            "{} exists: another program writes it, or one was interrupted; use --force to overwrite", part));
    }
    fail_io("create", part, errno);
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

PartFile::PartFile(std::string path, bool force) : path_{std::move(path)}, part_{path_ + ".part"}, force_{force} {
    check_target(path_, force_);
    // With force, what stands under either name goes.
    text::refuse_input(path_);
    text::refuse_input(part_);
    const Together lock;
    file_ = create_part(part_, force_);
    register_part(file_.get(), part_);
    text::note_output(file_.get());
}

void PartFile::discard() {
    const Together lock;
    if (file_.is_open() && is_still_named(file_.get(), part_)) ::unlink(part_.c_str());
    keep();
}

void PartFile::keep() {
    if (file_.is_open()) forget_part(file_.get());
    file_ = FileDescriptor{};
}

void PartFile::keep_if_abandoned() const { keep_part_if_abandoned(file_.get()); }

void PartFile::drop(bool keep_part) {
    if (!keep_part) ::unlink(part_.c_str());
}

void PartFile::complete(bool keep_part) {
    const Together lock;
    if (!is_still_named(file_.get(), part_)) {
        keep();
        throw IoError(fmt::format("cannot complete {}: another program has replaced or removed {}", path_, part_));
    }
    // What was read only after this file was begun.
    text::refuse_input(path_);
    forget_part(file_.get());
    if (::close(file_.release()) != 0) {
        const int error = errno;
        drop(keep_part);
        fail_io("write", part_, error);
    }
    if (const int error = rename_part(part_, path_, force_); error != 0) {
        drop(keep_part);
        const std::string where = keep_part ? fmt::format("; the log stays in {}", part_) : "";
        if (error == EEXIST) throw IoError(fmt::format("{} exists; use --force to overwrite{}", path_, where));
        throw IoError(fmt::format("cannot create {}: {}{}", path_, std::strerror(error), where));
    }
    note_complete(path_);
}

}  // namespace zlg::logs
