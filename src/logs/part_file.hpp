#pragma once
// A new file that is written as PATH.part and gets its name when it is complete.

#include <string>

#include "file_descriptor.hpp"

namespace zlg::logs {

class PartFile {
public:
    // Creates PATH.part for reading and writing.
    //
    // errors  IoError: PATH or PATH.part exists and not `force`, the folder is missing, PATH is a directory, no
    // permission.
    PartFile(std::string path, bool force);
    ~PartFile() { discard(); }
    PartFile(PartFile&&) noexcept = default;
    PartFile& operator=(PartFile&&) = delete;

    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] const std::string& part() const { return part_; }
    [[nodiscard]] bool is_open() const { return file_.is_open(); }
    [[nodiscard]] int fd() const { return file_.get(); }

    // Closes and removes PATH.part; one that another program has put in its place with force stays.
    void discard();

    // Closes PATH.part and leaves it.
    void keep();

    // It can be read as it is: `abandon_outputs` leaves it.
    void keep_if_abandoned() const;

    // Closes PATH.part and renames it to PATH. When that fails PATH.part is removed, or stays where `keep_part` says
    // so.
    //
    // errors  IoError: the last bytes were not written, another program took PATH.part, PATH has appeared meanwhile and
    // not `force`.
    void complete(bool keep_part = false);

private:
    void drop(bool keep_part);

    std::string path_;
    std::string part_;
    bool force_;
    FileDescriptor file_;
};

}  // namespace zlg::logs
