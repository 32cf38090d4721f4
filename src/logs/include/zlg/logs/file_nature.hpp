#pragma once
// What a file is that is no text, by its content.

#include <string>

namespace zlg::logs {

// "a NumPy array (.npy)", "a MATLAB 5 file", "HDF5 with a user block of 512 bytes", or just "a binary file"; empty for
// text, and for what is no regular file, of which nothing is read.
//
// errors  IoError: the file cannot be opened or read.
[[nodiscard]] std::string foreign_nature(const std::string& path);

// errors  FormatError: the file is known to be something else than text; it says what.
void refuse_foreign(const std::string& path);

}  // namespace zlg::logs
