#include <zlg/logs/unfinished.hpp>

#include <sys/stat.h>
#include <unistd.h>

#include <map>
#include <mutex>
#include <set>
#include <utility>

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

}  // namespace

bool is_still_named(int fd, const std::string& name) {
    struct stat open_file {};
    struct stat named_file {};
    return ::fstat(fd, &open_file) == 0 && ::lstat(name.c_str(), &named_file) == 0 &&
           open_file.st_dev == named_file.st_dev && open_file.st_ino == named_file.st_ino;
}

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

void register_part(int fd, const std::string& part) {
    const Together lock;
    unfinished().parts.insert_or_assign(fd, Part{part});
}

void forget_part(int fd) {
    const Together lock;
    unfinished().parts.erase(fd);
}

void note_complete(const std::string& name) {
    const Together lock;
    unfinished().complete.push_back(name);
}

void keep_part_if_abandoned(int fd) {
    const Together lock;
    const auto part = unfinished().parts.find(fd);
    if (part != unfinished().parts.end()) part->second.stays = true;
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

}  // namespace zlg::logs
