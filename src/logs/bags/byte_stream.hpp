#pragma once
// Bytes that come block by block, from a file or from what is unpacked, handed out in pieces of any length.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace zlg::logs::bags {

// The bytes are not what they must be; the line says what and what is allowed, and whoever catches it, where.
struct Damaged : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// The file ends within what was begun.
struct CutOff {};

// Of what is looked at, and not skipped: a name, a definition, a message of an IMU.
inline constexpr std::size_t max_piece = std::size_t{1} << 20;

class ByteStream {
public:
    enum class End { of_file, of_chunk };

    // `next` gives a block that is good until it is called again; an empty one is the end.
    ByteStream(std::function<std::string_view()> next, End end) : next_{std::move(next)}, end_{end} {}

    // The next n bytes, good until the next call. errors  as all that follow: CutOff, Damaged.
    [[nodiscard]] std::string_view take(std::size_t n);
    // Some bytes, at most so many.
    [[nodiscard]] std::string_view take_some(std::uint64_t most);
    void skip(std::uint64_t n);
    [[nodiscard]] bool is_at_end();

    // Of what was taken: how many bytes, and their CRC-32.
    [[nodiscard]] std::uint64_t at() const { return at_; }
    [[nodiscard]] std::uint32_t crc() const { return crc_; }

private:
    [[nodiscard]] std::string_view counted(std::string_view bytes);

    std::function<std::string_view()> next_;
    End end_;
    std::string_view block_;  // what is left of it
    std::string joined_;      // of several blocks
    std::uint64_t at_ = 0;
    std::uint32_t crc_ = 0;
};

}  // namespace zlg::logs::bags
