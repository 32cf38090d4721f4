// Numbers as they lie in memory: NumPy's .npy, and rows of doubles without a header, as PSINS writes its .imu.

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <regex>
#include <zlg/logs/budget.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/logs/row_times.hpp>
#include <zlg/text/escape.hpp>

#include "foreign_readers.hpp"
#include "stored_numbers.hpp"

namespace zlg::logs {

namespace {

constexpr std::size_t max_width = 40;

// The least width at which a column rises evenly by a step: a column of times. 0: none.
std::size_t width_of(StoredMatrix all, std::size_t n) {
    for (std::size_t width = 2; width <= max_width && 4 * width <= n; ++width) {
        if (n % width != 0) continue;
        const std::size_t rows = std::min<std::size_t>(n / width, 1000);
        all.columns = width;
        const std::vector<double> values = array_of({}, all).read(0, rows, false);
        for (const std::size_t c : {std::size_t{0}, width - 1})
            if (const auto at = values.begin() + static_cast<std::ptrdiff_t>(c * rows);
                rises_as_time(std::vector(at, at + static_cast<std::ptrdiff_t>(rows))))
                return width;
    }
    return 0;
}

std::optional<NumberType> type_of(std::string_view descr) {
    constexpr std::string_view names = "i1 u1 i2 u2 i4 u4 i8 u8 f4 f8";  // in the order of NumberType
    if (descr.size() != 3 || (descr[0] != '<' && descr[0] != '|')) return std::nullopt;
    const std::size_t at = names.find(descr.substr(1));
    if (at == std::string_view::npos || at % 3 != 0 || descr.ends_with("u8")) return std::nullopt;
    return static_cast<NumberType>(at / 3);
}

// Behind the signature: two bytes of a version, the length of the head in 2 or 4 bytes, the head.
class NpyFile {
public:
    explicit NpyFile(const std::string& path) : path_{path}, bytes_{Piece::of_file(path)} {}

    StoredMatrix matrix() {
        const std::string head = read_head();
        // The dictionary as NumPy, and whoever writes for it, spells it.
        static const std::regex spelled{R"(\{ *'descr': *'([^'\\]*)', *'fortran_order': *(True|False), )"
                                        R"(*'shape': *\((\d{1,18}),(?: *(\d{1,18}),?)?\),? *\})"};
        std::smatch said;
        if (!std::regex_match(head, said, spelled)) fail("of another type or shape");
        const auto type = type_of(said.str(1));
        if (!type) fail(fmt::format("of the type '{}'", text::excerpt(said.str(1), 40, '?')));
        const std::size_t n = std::stoull(said.str(3)), m = said[4].matched ? std::stoull(said.str(4)) : 1;
        Budget{path_, bytes_.size()}.take_values(n, m);
        const std::size_t size = n * m * size_of(*type);
        if (size == 0) fail("without numbers");
        if (bytes_.size() - begin_ < size) fail("that is cut off");
        if (std::min(n, m) > max_matrix_columns) fail(fmt::format("of more than {} columns", max_matrix_columns));
        StoredMatrix stored{.bytes = bytes_.part(begin_, size), .type = *type};
        stored.take_shape(n, m, said.str(2) == "False");
        return stored;
    }

private:
    [[noreturn]] void fail(const std::string& what) const {
        throw FormatError(fmt::format(
            "{}: a NumPy array {}; allowed are plain numbers, little-endian, of one or two dimensions", path_, what));
    }

    std::string read_head() {
        constexpr std::size_t max_head = 1000;  // of plain numbers it has some 100
        if (bytes_.size() < 12) fail("that is cut off");
        const std::string start = bytes_.text(6, 6);
        const auto byte = [&start](std::size_t k) { return std::size_t{static_cast<unsigned char>(start[k])}; };
        if (byte(0) < 1 || byte(0) > 3 || byte(1) != 0) fail(fmt::format("of version {}.{}", byte(0), byte(1)));
        const bool is_long = byte(0) > 1;
        const std::size_t length = byte(2) | byte(3) << 8 | (is_long ? byte(4) << 16 | byte(5) << 24 : 0);
        if (length > max_head) fail(fmt::format("with a head of {} bytes, where {} is the most", length, max_head));
        const std::size_t at = is_long ? 12 : 10;
        begin_ = at + length;
        if (begin_ > bytes_.size()) fail("that is cut off");
        std::string head = bytes_.text(at, length);
        head.erase(head.find_last_not_of(" \n") + 1);
        return head;
    }

    const std::string& path_;
    Piece bytes_;
    std::size_t begin_ = 0;
};

}  // namespace

ForeignTable numpy_table_of(const std::string& path) {
    return table_of_arrays(path, "a NumPy array", {array_of({}, NpyFile{path}.matrix())});
}

ForeignTable doubles_table_of(const std::string& path) {
    StoredMatrix all{.bytes = Piece::of_file(path)};
    const std::size_t n = all.bytes.size() / sizeof(double);
    const std::size_t width = width_of(all, n);
    if (width == 0)
        throw FormatError(fmt::format(
            "{}: doubles without a header, and no column of times shows how many make a row; allowed are rows of 2..{} "
            "numbers, the first or the last of which rises evenly",
            path, max_width));
    Budget{path, all.bytes.size()}.take_values(n, 1);
    all.rows = n / width;
    all.columns = width;
    ForeignTable table =
        table_of_arrays(path, fmt::format("doubles without a header, {} to a row", width), {array_of({}, all)});
    if (width == 7 && path.ends_with(".imu") && rises_as_time(table.columns.back().values))
        table.notes.push_back(
            "as PSINS writes it, columns 1..3 are increments of angle in rad, 4..6 of velocity, 7 the times in s");
    return table;
}

}  // namespace zlg::logs
