#pragma once
// An HDF5 file is known by its first bytes, or by those behind a user block.

#include <string>

namespace zlg::logs {

// Where the signature of HDF5 stands: 0, or behind a user block of 512, 1024, 2048, ... bytes; -1: nowhere.
//
// errors  IoError: the file cannot be read; `path` is named.
[[nodiscard]] long long hdf5_offset(int open_file, const std::string& path);

// False for a pipe or a device, of which nothing is read.
//
// errors  IoError: the file cannot be opened or read.
[[nodiscard]] bool has_hdf5_signature(const std::string& path);

}  // namespace zlg::logs
