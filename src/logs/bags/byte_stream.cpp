#include "byte_stream.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>

namespace zlg::logs::bags {

std::string_view ByteStream::counted(std::string_view bytes) {
    at_ += bytes.size();
    crc_ = static_cast<std::uint32_t>(crc32_z(crc_, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
    return bytes;
}

bool ByteStream::is_at_end() {
    if (block_.empty()) block_ = next_();
    return block_.empty();
}

std::string_view ByteStream::take_some(std::uint64_t most) {
    if (is_at_end()) {
        if (end_ == End::of_file) throw CutOff{};
        throw Damaged("a record in it goes on behind its end; allowed are whole records");
    }
    const auto n = static_cast<std::size_t>(std::min<std::uint64_t>(most, block_.size()));
    const std::string_view bytes = block_.substr(0, n);
    block_.remove_prefix(n);
    return counted(bytes);
}

std::string_view ByteStream::take(std::size_t n) {
    if (n > max_piece) throw Damaged(fmt::format("holds a piece of {} bytes; allowed are {}", n, max_piece));
    if (block_.size() >= n && n > 0) return take_some(n);
    joined_.clear();
    while (joined_.size() < n) joined_ += take_some(n - joined_.size());
    return joined_;
}

void ByteStream::skip(std::uint64_t n) {
    while (n > 0) n -= take_some(n).size();
}

}  // namespace zlg::logs::bags
