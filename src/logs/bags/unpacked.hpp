#pragma once
// What a chunk of a bag holds: stored, or packed by LZ4 or Zstandard, and unpacked block by block.

#include <cstdint>
#include <string_view>

#include "byte_stream.hpp"

namespace zlg::logs::bags {

// The next `n_packed` bytes of `file`, unpacked. `allowed` is lessened by what comes out, and outlives the stream.
//
// errors  Damaged: of no such compression, or, later, no such data, or more than is allowed.
[[nodiscard]] ByteStream unpacked(ByteStream& file, std::string_view compression, std::uint64_t n_packed,
                                  std::uint64_t& allowed);

}  // namespace zlg::logs::bags
