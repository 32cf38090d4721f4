#include <zlg/text/inputs.hpp>

#include <sys/stat.h>

#include <algorithm>
#include <mutex>
#include <vector>

#include <fmt/format.h>

namespace zlg::text {
namespace {

struct Noted {
    dev_t device;
    ino_t inode;
    friend bool operator==(const Noted&, const Noted&) = default;
};

// Verbs read in several threads. A machine without threads has no locks either.
#ifdef _LIBCPP_HAS_NO_THREADS
struct Mutex {};
struct Lock {
    explicit Lock(Mutex&) {}
};
#else
using Mutex = std::mutex;
using Lock = std::lock_guard<Mutex>;
#endif

struct List {
    Mutex mutex;
    bool watches = false;
    std::vector<Noted> files;
    std::vector<Noted> outputs;
};

List& list() {
    static List the_list;
    return the_list;
}

bool holds(const std::vector<Noted>& files, const Noted& file) {
    return std::find(files.begin(), files.end(), file) != files.end();
}

// Only a regular file can be overwritten by one that takes its name.
void note(const struct stat& status) {
    if (!S_ISREG(status.st_mode)) return;
    const Lock lock{list().mutex};
    const Noted file{status.st_dev, status.st_ino};
    if (list().watches && !holds(list().files, file)) list().files.push_back(file);
}

}  // namespace

void watch_inputs() {
    const Lock lock{list().mutex};
    list().watches = true;
}

void note_input(int open_file) {
    struct stat status {};
    if (::fstat(open_file, &status) == 0) note(status);
}

void note_input(const std::string& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) == 0) note(status);
}

void note_output(int open_file) {
    struct stat status {};
    if (::fstat(open_file, &status) != 0) return;
    const Lock lock{list().mutex};
    if (list().watches) list().outputs.push_back({status.st_dev, status.st_ino});
}

bool is_own_output(const std::string& path) {
    struct stat status {};
    if (::lstat(path.c_str(), &status) != 0) return false;
    const Lock lock{list().mutex};
    return holds(list().outputs, {status.st_dev, status.st_ino});
}

void refuse_input(const std::string& output_path) {
    struct stat status {};
    if (::stat(output_path.c_str(), &status) != 0) return;
    const Lock lock{list().mutex};
    if (!holds(list().files, {status.st_dev, status.st_ino})) return;
    throw OutputIsInput{fmt::format("{}: is an input; name another file", output_path)};
}

}  // namespace zlg::text
