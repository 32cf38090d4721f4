#pragma once

#include <string>

namespace zlg::text {

// A file for reading, noted as an input; closed however reading ends.
class OpenFile {
public:
    // errors  CannotRead.
    explicit OpenFile(const std::string& path);
    ~OpenFile();
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;

    // Appends what comes next, a block at most; false at the end. errors  CannotRead.
    bool append_to(std::string& text);

private:
    int fd_;
};

}  // namespace zlg::text
