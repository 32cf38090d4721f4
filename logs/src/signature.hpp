#pragma once
// An HDF5 file is told by its first bytes.

#include <string>

namespace zlg::logs {

// False for a pipe or a device, of which nothing is read.
//
// errors  IoError: the file cannot be opened or read.
[[nodiscard]] bool has_hdf5_signature(const std::string& path);

}  // namespace zlg::logs
