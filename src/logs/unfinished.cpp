#include <zlg/logs/unfinished.hpp>

#include <fcntl.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <map>
#include <mutex>
#include <set>
#include <utility>

#include <fmt/format.h>

#include <zlg/logs/error.hpp>
#include <zlg/text/inputs.hpp>

#include "part_file.hpp"

namespace zlg::logs {
namespace {

struct Part {
    std::string name;
    bool stays = false;
};

// One for the process, as its file descriptors are. It is never destroyed: another thread may end the process
// meanwhile.
struct Unfinished {
    std::recursive_mutex mutex;
    std::map<int, Part> parts;
    std::vector<std::string> complete;
    std::set<std::string> folders;
};

Unfinished& unfinished() {
    static auto& the_one = *new Unfinished;
    return the_one;
}

bool is_still_named(int fd, const std::string& name) {
    struct stat open_file {};
    struct stat named_file {};
    return ::fstat(fd, &open_file) == 0 && ::lstat(name.c_str(), &named_file) == 0 &&
           open_file.st_dev == named_file.st_dev && open_file.st_ino == named_file.st_ino;
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

Together::Together() { unfinished().mutex.lock(); }
Together::~Together() { unfinished().mutex.unlock(); }

NewFolder::NewFolder(std::string path) : path_{std::move(path)} {
    const Together lock;
    unfinished().folders.insert(path_);
}

NewFolder::~NewFolder() {
    const Together lock;
    unfinished().folders.erase(path_);
}

std::optional<Remains> abandon_outputs() {
    Unfinished& u = unfinished();
    if (!u.mutex.try_lock()) return std::nullopt;
    Remains remains{.parts = {}, .complete = u.complete};
    for (const auto& [fd, part] : u.parts) {
        if (!is_still_named(fd, part.name)) continue;
        if (part.stays)
            remains.parts.push_back(part.name);
        else
            ::unlink(part.name.c_str());
    }
    // The innermost first; one with something in it stays.
    for (auto folder = u.folders.rbegin(); folder != u.folders.rend(); ++folder) ::rmdir(folder->c_str());
    return remains;
}

PartFile::PartFile(std::string path, bool force) : path_{std::move(path)}, part_{path_ + ".part"}, force_{force} {
    check_target(path_, force_);
    // With force, what stands under either name goes.
    text::refuse_input(path_);
    text::refuse_input(part_);
    const Together lock;
    file_ = create_part(part_, force_);
    unfinished().parts.insert_or_assign(file_.get(), Part{part_});
    text::note_output(file_.get());
}

void PartFile::discard() {
    const Together lock;
    if (file_.is_open() && is_still_named(file_.get(), part_)) ::unlink(part_.c_str());
    keep();
}

void PartFile::keep() {
    const Together lock;
    if (file_.is_open()) unfinished().parts.erase(file_.get());
    file_ = FileDescriptor{};
}

void PartFile::keep_if_abandoned() const {
    const Together lock;
    const auto part = unfinished().parts.find(file_.get());
    if (part != unfinished().parts.end()) part->second.stays = true;
}

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
    unfinished().parts.erase(file_.get());
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
    unfinished().complete.push_back(path_);
}

}  // namespace zlg::logs
