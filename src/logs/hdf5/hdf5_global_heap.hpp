#pragma once
// Where HDF5 keeps texts of their own length: collections of objects, one behind the other.
//
// The library walks through a collection by the sizes that it finds in it and relies on them: with a damaged size it
// walks for ever. Collections have no checksum, so they are walked here first.

#include <cstdint>

namespace zlg::logs::hdf5 {

// Does a collection begin at byte `address` of the file whose own size, or the size of one of its objects, leads behind
// its end or nowhere? False where none begins.
// Source: HDF5 File Format Specification, version 3.0, section III.E.
[[nodiscard]] bool is_damaged_heap_collection(int fd, std::uint64_t address);

}  // namespace zlg::logs::hdf5
