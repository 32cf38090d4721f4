#pragma once
// What a file is, told from its content and never from its suffix.

#include <string>

namespace zlg::logs {

enum class LogKind {
    raw_csv,    // half-periods
    angle_csv,  // ticks
    hdf5,       // by its signature
    unknown,    // also an empty file
};

// A CSV log is recognised by two or more of its column names, so that a misspelt one still gets to the reader that
// names it.
//
// errors  IoError: no such file, a folder, a pipe or device (it could not be read a second time), no permission.
[[nodiscard]] LogKind recognise(const std::string& path);

}  // namespace zlg::logs
