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

// Where the signature of HDF5 stands: 0, or behind a user block of 512, 1024, 2048, ... bytes; -1: nowhere.
//
// errors  IoError: the file cannot be read; `path` is named.
[[nodiscard]] long long hdf5_offset(int open_file, const std::string& path);

// False for a pipe or a device, of which nothing is read.
//
// errors  IoError: the file cannot be opened or read.
[[nodiscard]] bool has_hdf5_signature(const std::string& path);

}  // namespace zlg::logs
