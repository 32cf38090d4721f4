#include "matlab5_extent.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <zlg/logs/error.hpp>

#include "foreign_readers.hpp"

namespace zlg::logs {

namespace {

constexpr std::size_t header_bytes = 128, tag_bytes = 8;
constexpr std::uint32_t matrix = 14, compressed = 15;
constexpr int max_depth = 16;

// Bytes of a number of the types 1 to 13 of MathWorks' description, 0: none.
constexpr std::array<std::size_t, 14> size_of_type{0, 1, 1, 2, 2, 4, 4, 4, 0, 8, 0, 0, 8, 8};

struct Element {
    std::uint32_t type = 0;
    std::string_view data;
};

class Walk {
public:
    Walk(const std::string& path, bool swapped) : path_{path}, swapped_{swapped} {}

    void file(std::string_view bytes) const {
        for (std::size_t at = header_bytes; at < bytes.size();) {
            where_ = at;
            const Element element = next(bytes, at, true);
            if (element.type == compressed)
                inflated(element.data);
            else if (element.type == matrix)
                check_matrix(element.data, 0);
        }
    }

private:
    [[noreturn]] void refuse(const char* what) const {
        throw FormatError(
            fmt::format("{}: the variable at byte {} {}; the file is cut off or damaged, allowed is a whole one", path_,
                        where_, what));
    }

    [[nodiscard]] std::uint32_t word(std::string_view bytes, std::size_t at) const {
        std::uint32_t value = 0;
        std::memcpy(&value, bytes.data() + at, sizeof value);
        return swapped_ ? __builtin_bswap32(value) : value;
    }

    // The element at that place, and the place behind it. A compressed one has no padding.
    Element next(std::string_view bytes, std::size_t& at, bool is_outer = false) const {
        if (bytes.size() - at < tag_bytes) refuse("has no whole tag");
        const std::uint32_t first = word(bytes, at);
        if (!is_outer && first >> 16 != 0) {  // up to 4 bytes within the tag
            if (first >> 16 > 4) refuse("has a short element of more than 4 bytes");
            const Element element{first & 0xFFFFu, bytes.substr(at + 4, first >> 16)};
            at += tag_bytes;
            return element;
        }
        const std::size_t size = word(bytes, at + 4);
        if (size > bytes.size() - at - tag_bytes) refuse("has fewer bytes than it says");
        const Element element{first, bytes.substr(at + tag_bytes, size)};
        const std::size_t padding = first == compressed ? 0 : (8 - size % 8) % 8;
        at = std::min(at + tag_bytes + size + padding, bytes.size());
        return element;
    }

    void inflated(std::string_view data) const {
        std::string bytes;
        std::string piece(std::size_t{1} << 20, '\0');
        z_stream stream{};
        if (inflateInit(&stream) != Z_OK) refuse("cannot be decompressed");
        stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(data.data()));
        stream.avail_in = static_cast<uInt>(data.size());
        int state = Z_OK;
        while (state == Z_OK && bytes.size() <= max_foreign_values * sizeof(double)) {
            stream.next_out = reinterpret_cast<Bytef*>(piece.data());
            stream.avail_out = static_cast<uInt>(piece.size());
            state = inflate(&stream, Z_NO_FLUSH);
            bytes.append(piece, 0, piece.size() - stream.avail_out);
        }
        inflateEnd(&stream);
        if (state != Z_STREAM_END) refuse("has compressed bytes that do not end");
        std::size_t at = 0;
        const Element element = next(bytes, at, true);
        if (element.type == matrix) check_matrix(element.data, 0);
    }

    // Flags, dimensions, name, and the numbers or, of structures and cells, matrices.
    void check_matrix(std::string_view bytes, int depth) const {
        if (bytes.empty()) return;  // a field that holds nothing
        if (depth > max_depth) refuse("has structures in structures without end");
        std::size_t at = 0;
        const Element flags = next(bytes, at);
        if (flags.data.size() != 8) refuse("has no flags");
        const std::uint32_t kind = word(flags.data, 0) & 0xFFu;
        const bool is_complex = (word(flags.data, 0) & 0x800u) != 0;
        if (kind > 3 && kind < 6) return;  // sparse matrices and texts are not read
        if (kind > 15) return;
        const Element dimensions = next(bytes, at);
        std::size_t n = 1;
        for (std::size_t d = 0; d + 4 <= dimensions.data.size(); d += 4) {
            n *= word(dimensions.data, d);
            if (n > max_foreign_values) refuse("has more numbers than can be read");
        }
        (void)next(bytes, at);  // the name
        if (kind >= 6) {
            for (int part = 0; part < (is_complex ? 2 : 1); ++part) {
                if (n == 0 && at == bytes.size()) return;
                const Element numbers = next(bytes, at);
                const std::size_t size = numbers.type < size_of_type.size() ? size_of_type[numbers.type] : 0;
                if (size == 0 || numbers.data.size() != n * size) refuse("has other dimensions than numbers");
            }
            return;
        }
        while (at < bytes.size()) {
            const Element inner = next(bytes, at);
            if (inner.type == matrix) check_matrix(inner.data, depth + 1);
        }
    }

    const std::string& path_;
    bool swapped_;
    mutable std::size_t where_ = 0;
};

}  // namespace

void check_matlab5_extent(const std::string& path) {
    const std::string bytes = bytes_of(path);
    if (bytes.size() < header_bytes) throw FormatError(fmt::format("{}: a MATLAB 5 file that is cut off", path));
    Walk{path, bytes[126] == 'M'}.file(bytes);
}

}  // namespace zlg::logs
