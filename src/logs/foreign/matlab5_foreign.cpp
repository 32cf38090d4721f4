// MATLAB 5: real matrices, and those in structures. By MathWorks' description of the format, and not by libmatio, which
// takes the memory that a file asks for and gives what nobody wrote where bytes are missing.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>
#include <zlg/logs/budget.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/text/escape.hpp>

#include "foreign_readers.hpp"
#include "inflated.hpp"
#include "stored_numbers.hpp"

namespace zlg::logs {

namespace {

constexpr std::size_t header_bytes = 128, tag_bytes = 8;
constexpr std::uint32_t matrix = 14, compressed = 15;
constexpr int max_depth = 4;

enum Kind : std::uint32_t { structure = 2, first_of_numbers = 6, last_of_numbers = 15 };

std::optional<NumberType> type_of(std::uint32_t type) {
    using enum NumberType;
    constexpr std::optional<NumberType> none;
    constexpr std::array<std::optional<NumberType>, 14> types{none, i1,   u1, i2,   u2,   i4, u4,
                                                              f4,   none, f8, none, none, i8, u8};
    return type < types.size() ? types[type] : none;
}

struct Element {
    std::uint32_t type = 0;
    Piece data = {};
};

// Elements one behind the other.
struct Rest {
    Piece bytes = {};
    std::size_t at = 0;
    [[nodiscard]] bool is_empty() const { return at >= bytes.size(); }
};

class Matlab5Reader {
public:
    Matlab5Reader(const std::string& path, std::string asked)
        : path_{path}, asked_{std::move(asked)}, file_{Piece::of_file(path)}, budget_{path, file_.size()} {
        if (file_.size() < header_bytes) throw FormatError(fmt::format("{}: a MATLAB 5 file that is cut off", path));
        swapped_ = file_.text(126, 1) == "M";
    }

    void read() {
        Rest rest{file_, header_bytes};
        while (!rest.is_empty()) {
            where_ = rest.at;
            const Element element = next(rest, true);
            if (element.type == compressed)
                take_compressed(element.data);
            else if (element.type == matrix)
                take_matrix(element.data, {}, 0);
        }
        if (!asked_.empty() && !found_)
            throw MappingError(fmt::format("{}: table = '{}': there is no such variable", path_, asked_));
    }

    std::vector<ForeignArray> arrays;
    std::vector<std::string> notes;

private:
    [[noreturn]] void refuse(const char* what) const {
        throw FormatError(
            fmt::format("{}: the variable at byte {} {}; the file is cut off or damaged, allowed is a whole one", path_,
                        where_, what));
    }

    [[nodiscard]] std::uint32_t word(const Piece& bytes, std::size_t at) const {
        std::uint32_t value = 0;
        bytes.read(at, sizeof value, reinterpret_cast<char*>(&value));
        return swapped_ ? __builtin_bswap32(value) : value;
    }

    // The next element. A compressed one has no padding.
    Element next(Rest& rest, bool is_outer = false) const {
        const std::size_t left = rest.bytes.size() - rest.at;
        if (rest.is_empty() || left < tag_bytes) refuse("has no whole tag");
        const std::uint32_t first = word(rest.bytes, rest.at);
        if (!is_outer && first >> 16 != 0) {  // up to 4 bytes within the tag
            if (first >> 16 > 4) refuse("has a short element of more than 4 bytes");
            const Element element{first & 0xFFFFu, rest.bytes.part(rest.at + 4, first >> 16)};
            rest.at += tag_bytes;
            return element;
        }
        const std::size_t size = word(rest.bytes, rest.at + 4);
        if (size > left - tag_bytes) refuse("has fewer bytes than it says");
        const Element element{first, rest.bytes.part(rest.at + tag_bytes, size)};
        const std::size_t padding = first == compressed ? 0 : (8 - size % 8) % 8;
        rest.at = std::min(rest.at + tag_bytes + size + padding, rest.bytes.size());
        return element;
    }

    // The tag that the bytes begin with says how many they are.
    void take_compressed(const Piece& packed) {
        std::string tag;
        std::size_t most = 0, n = 0;
        const auto read = [&packed](std::size_t at, std::size_t size, char* to) { packed.read(at, size, to); };
        const auto take = [&](std::string_view piece) {
            if (tag.size() < tag_bytes) tag += piece.substr(0, tag_bytes);
            if (most == 0 && tag.size() >= tag_bytes) {
                std::uint32_t size = 0;
                std::memcpy(&size, tag.data() + 4, sizeof size);
                most = 2 * tag_bytes + (swapped_ ? __builtin_bswap32(size) : size);
                budget_.take_unpacked(most);
            }
            n += piece.size();
            return most == 0 || n <= most;
        };
        if (!inflate_all(packed.size(), read, take))
            refuse("has compressed bytes that do not end, or are more than they say");
        Rest rest{Piece::of_packed(packed, n)};
        const Element element = next(rest, true);
        if (element.type == matrix) take_matrix(element.data, {}, 0);
    }

    void note(const std::string& name, const char* what) {
        if (notes.size() < 10) notes.push_back(fmt::format("'{}' {}", text::excerpt(name, 60, ' '), what));
    }

    void leave_out(const std::string& name) { note(name, "is left out: it is no real matrix"); }

    // Flags, dimensions, name, and the numbers or, of structures and cells, matrices. Of an inner one the name is
    // given.
    void take_matrix(const Piece& bytes, std::string name, int depth) {
        budget_.take_object();
        if (bytes.size() == 0) return;  // a field that holds nothing
        Rest rest{bytes};
        const Element flags = next(rest);
        if (flags.data.size() != 8) refuse("has no flags");
        const std::uint32_t flag_word = word(flags.data, 0), kind = flag_word & 0xFFu;
        if (kind > last_of_numbers) return leave_out(name);  // functions, and objects without a description
        const std::vector<std::size_t> size = dimensions(next(rest).data);
        const Element own_name = next(rest);
        if (depth == 0) {
            name = own_name.data.text(0, own_name.data.size());
            if (!asked_.empty() && name != asked_) return;
            found_ = true;
        }
        if (kind >= first_of_numbers) return take_numbers(rest, name, size, (flag_word & 0x800u) != 0);
        if (kind == structure) return take_fields(rest, name, depth);
        leave_out(name);
    }

    [[nodiscard]] std::vector<std::size_t> dimensions(const Piece& bytes) const {
        if (bytes.size() < 8 || bytes.size() > 4 * 32) refuse("has no dimensions");
        std::vector<std::size_t> size;
        for (std::size_t d = 0; d + 4 <= bytes.size(); d += 4) size.push_back(word(bytes, d));
        return size;
    }

    void take_numbers(Rest rest, const std::string& name, const std::vector<std::size_t>& size, bool is_complex) {
        std::size_t n = 1;
        for (const std::size_t one : size) {
            if (one > 0 && n > budget_.max_values() / one) refuse("has more numbers than can be read");
            n *= one;
        }
        if (n == 0 && rest.is_empty()) return;
        std::optional<Element> numbers;
        std::optional<NumberType> type;
        for (int part = 0; part < (is_complex ? 2 : 1); ++part) {
            numbers = next(rest);
            type = type_of(numbers->type);
            if (!type || numbers->data.size() != n * size_of(*type)) refuse("has other dimensions than numbers");
        }
        if (size.size() != 2 || is_complex) return leave_out(name);
        if (n < 2) return;
        if (std::min(size[0], size[1]) > max_matrix_columns) return leave_out(name);
        budget_.take_values(size[0], size[1]);
        StoredMatrix stored{.bytes = numbers->data, .type = *type, .swapped = swapped_};
        stored.take_shape(size[0], size[1], false);  // column by column
        arrays.push_back(array_of(name, stored));
    }

    // The fields of the first element; those of the others follow.
    void take_fields(Rest rest, const std::string& name, int depth) {
        if (depth >= max_depth) return leave_out(name);
        const Element length = next(rest);
        const std::size_t bytes_of_name = length.data.size() == 4 ? word(length.data, 0) : 0;
        const Element names = next(rest);
        if (bytes_of_name == 0 || bytes_of_name > 4096) refuse("has fields without names");
        const std::size_t n_fields = names.data.size() / bytes_of_name;
        for (std::size_t f = 0; f < n_fields && !rest.is_empty(); ++f) {
            const std::string padded = names.data.text(f * bytes_of_name, bytes_of_name);
            const Element field = next(rest);
            if (field.type != matrix) refuse("has a field that is no matrix");
            take_matrix(field.data, fmt::format("{}.{}", name, padded.c_str()), depth + 1);
        }
        if (!rest.is_empty()) note(name, "holds more than one structure: only the first is read");
    }

    const std::string& path_;
    std::string asked_;
    Piece file_;
    Budget budget_;
    bool swapped_ = false;
    bool found_ = false;
    std::size_t where_ = 0;
};

}  // namespace

ForeignTable matlab5_table_of(const std::string& path, const Mapping& mapping) {
    Matlab5Reader reader{path, mapping.text("table")};
    reader.read();
    return table_of_arrays(path, "a MATLAB 5 file", std::move(reader.arrays), reader.notes);
}

}  // namespace zlg::logs
