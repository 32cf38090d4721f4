#pragma once
// What the disk, the network or another program does to a file.

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "bytes.hpp"

namespace zlg::fuzz {

inline std::vector<std::uint8_t> content(const std::string& path) {
    std::ifstream file{path, std::ios::binary};
    return {std::istreambuf_iterator<char>{file}, std::istreambuf_iterator<char>{}};
}

// Of a byte: another value, a few of its bits, a short run of the same value, or an end of the file.
inline void spoil(Bytes& bytes, std::vector<std::uint8_t>& file) {
    const auto what = bytes.index(8);
    const std::size_t at = bytes.take<std::uint32_t>() % file.size();
    const auto value = bytes.take<std::uint8_t>();
    if (what < 4) file[at] = value;
    if (what == 4 || what == 5) file[at] = static_cast<std::uint8_t>(file[at] ^ value);
    if (what == 6)
        std::fill_n(file.begin() + static_cast<std::ptrdiff_t>(at), std::min<std::size_t>(8, file.size() - at), value);
    if (what == 7 && at > 0) file.resize(at);
}

}  // namespace zlg::fuzz
