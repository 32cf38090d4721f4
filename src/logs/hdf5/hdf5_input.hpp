#pragma once
// How the HDF5 library reads a log: nothing is made up for what the file does not hold.
//
// The library's own driver hands out zeros behind the end of a file, and of a growing log it does not ask where the end
// is. A log whose tail was lost would read as zeros.

#include "hdf5_handle.hpp"

namespace zlg::logs::hdf5 {

// File access properties: reads `fd`, which must outlive the file, and fails for rows behind its end. Structures of the
// library are still filled up with zeros, since it reads them ahead; they have checksums.
[[nodiscard]] Handle access_to_read(int fd);

}  // namespace zlg::logs::hdf5
