#pragma once
// What the pieces of a data set become when they are unpacked: the library takes that memory without asking.

#include <cstddef>
#include <string>

#include "hdf5_source.hpp"

namespace zlg::logs::hdf5 {

// Of a data set of one or two dimensions.
//
// errors  FormatError: a chunk of more than `max_bytes`, one that is packed twice, or unpacks to more than its numbers.
void check_chunks(const Source& source, const std::string& path, hid_t set, std::size_t max_bytes);

}  // namespace zlg::logs::hdf5
