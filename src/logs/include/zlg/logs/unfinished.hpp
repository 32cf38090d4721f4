#pragma once
// What is being written at this moment, for a program that must end at once and leave nothing that it should not.

#include <optional>
#include <string>
#include <vector>

namespace zlg::logs {

// While one lives, `abandon_outputs` of another thread does nothing: for files that get their names together, all or
// none. May be nested.
class Together {
public:
    Together();
    ~Together();
    Together(const Together&) = delete;
    Together& operator=(const Together&) = delete;
};

// A folder that was made for files which may yet fail. `abandon_outputs` removes it if it is empty.
class NewFolder {
public:
    explicit NewFolder(std::string path);
    ~NewFolder();
    NewFolder(const NewFolder&) = delete;
    NewFolder& operator=(const NewFolder&) = delete;

private:
    std::string path_;
};

// What an abandoned program leaves.
struct Remains {
    std::vector<std::string> parts;     // NAME.part that holds rows
    std::vector<std::string> complete;  // files that had got their names before
};

// Removes every NAME.part that this program is writing, except those that hold rows and can be read as they are. A file
// that another program has put under such a name stays. From then on no file is completed: a thread that tries to waits
// for ever. To be called last, before the end of the process, by a thread that holds no `Together`.
//
// return  what stays; nothing, and nothing done, while another thread holds a `Together`: try again.
[[nodiscard]] std::optional<Remains> abandon_outputs();

}  // namespace zlg::logs
