#pragma once
// What the pieces of a data set become when they are unpacked: the library takes that memory without asking.

#include <array>
#include <cstddef>
#include <string>

#include "hdf5_source.hpp"

namespace zlg::logs::hdf5 {

// Of a data set of one or two dimensions: values of a chunk in each, all of it where there are none.
//
// errors  FormatError: a chunk of more than `max_bytes`, one that is packed twice, or unpacks to more than its numbers.
[[nodiscard]] std::array<hsize_t, 2> checked_chunk(const Source& source, const std::string& path, hid_t set,
                                                   std::size_t max_bytes);

}  // namespace zlg::logs::hdf5
