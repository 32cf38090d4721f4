#pragma once
// A stream of zlib, unpacked piece by piece: what it makes is the taker's to keep or to pass over.

#include <cstddef>
#include <functional>
#include <string_view>

namespace zlg::logs {

// `read(at, n, to)` reads packed bytes, of which there are `n_packed`; `take` says whether to go on.
//
// Returns whether the stream is whole and all of it was taken.
[[nodiscard]] bool inflate_all(std::size_t n_packed,
                               const std::function<void(std::size_t at, std::size_t n, char* to)>& read,
                               const std::function<bool(std::string_view)>& take);

}  // namespace zlg::logs
