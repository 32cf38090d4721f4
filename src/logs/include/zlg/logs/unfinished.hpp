#pragma once
// What is being written at this moment, for a program that must end at once and leave nothing that it should not.

#include <optional>
#include <string>
#include <vector>

namespace zlg::logs {

// While it lives, nothing is abandoned: for files that get their names together, all or none. May be nested.
class Together {
public:
    Together();
    ~Together();
    Together(const Together&) = delete;
    Together& operator=(const Together&) = delete;
};

// A folder that was made for files which may yet fail: abandoned without one, it goes.
class NewFolder {
public:
    explicit NewFolder(std::string path);
    ~NewFolder();
    NewFolder(const NewFolder&) = delete;
    NewFolder& operator=(const NewFolder&) = delete;

private:
    std::string path_;
};

// Removes every NAME.part of this program, as an error would, but those that may be kept and hold rows; their names come
// back. What another program has put under such a name stays, unnamed. From then on no file is completed: who tries waits for ever. To be called last, by any thread, before the end of
// the process. Nothing comes back while files are `Together`: try again.
[[nodiscard]] std::optional<std::vector<std::string>> abandon_outputs();

}  // namespace zlg::logs
