// Numbers as they lie in memory: NumPy's .npy, and rows of doubles without a header, as PSINS writes its .imu.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <regex>
#include <zlg/logs/error.hpp>
#include <zlg/logs/row_times.hpp>
#include <zlg/text/inputs.hpp>

#include "foreign_readers.hpp"

namespace zlg::logs {

namespace {

constexpr std::size_t max_width = 40;

template <class Number>
std::vector<double> numbers(std::string_view bytes, std::size_t n) {
    std::vector<double> values(n);
    for (std::size_t k = 0; k < n; ++k) {
        Number one;
        std::memcpy(&one, bytes.data() + k * sizeof one, sizeof one);
        values[k] = static_cast<double>(one);
    }
    return values;
}

std::vector<double> column(const std::vector<double>& values, std::size_t width, std::size_t c) {
    std::vector<double> one;
    for (std::size_t k = c; k < values.size() && one.size() < 1000; k += width) one.push_back(values[k]);
    return one;
}

// The least width at which a column rises evenly by a step: a column of times. 0: none.
std::size_t width_of(const std::vector<double>& values) {
    for (std::size_t width = 2; width <= max_width && 4 * width <= values.size(); ++width) {
        if (values.size() % width != 0) continue;
        for (const std::size_t c : {std::size_t{0}, width - 1})
            if (rises_as_time(column(values, width, c))) return width;
    }
    return 0;
}

}  // namespace

std::string bytes_of(const std::string& path) {
    zlg::text::note_input(path);
    std::ifstream file{path, std::ios::binary};
    file.seekg(0, std::ios::end);
    const auto size = static_cast<std::size_t>(std::max<std::streamoff>(file.tellg(), 0));
    if (size > max_foreign_values * sizeof(double))
        throw FormatError(fmt::format("{}: {} bytes; allowed is {}", path, size, max_foreign_values * sizeof(double)));
    std::string bytes(size, '\0');
    file.seekg(0);
    if (!file.read(bytes.data(), static_cast<std::streamsize>(size)))
        throw IoError(fmt::format("cannot read {}", path));
    return bytes;
}

ForeignTable numpy_table_of(const std::string& path) {
    const std::string bytes = bytes_of(path);
    const auto fail = [&](const std::string& what) {
        throw FormatError(
            fmt::format("{}: a NumPy array {}; allowed are plain numbers, little-endian, of one or two "
                        "dimensions",
                        path, what));
    };
    if (bytes.size() < 12) fail("that is cut off");
    const bool is_long = bytes[6] >= 2;
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 8, is_long ? 4 : 2);
    const std::size_t begin = (is_long ? 12u : 10u) + std::size_t{length};
    if (begin > bytes.size() || length > 65536) fail("that is cut off");
    const std::string head = bytes.substr(0, begin);
    std::smatch type, shape;
    const bool good = std::regex_search(head, type, std::regex{"'descr': *'[<|]([fiu])([1248])'"}) &&
                      std::regex_search(head, shape, std::regex{"'shape': *\\((\\d{1,10}),? ?(\\d{1,10})?,?\\)"});
    if (!good) fail("of another type or shape");
    const std::size_t n = std::stoul(shape[1]), m = shape[2].length() > 0 ? std::stoul(shape[2]) : 1;
    const std::string kind = type[1].str() + type[2].str();
    const std::size_t size = std::stoul(type[2]);
    if (n > max_foreign_values || m > max_foreign_values || n * m > max_foreign_values ||
        bytes.size() - begin < n * m * size)
        fail("that is cut off");
    const std::string_view data = std::string_view{bytes}.substr(begin);
    ForeignArray array{.name = {}, .unit = {}, .values = {}, .not_plain = {}};
    if (kind == "f8") array.values = numbers<double>(data, n * m);
    if (kind == "f4") array.values = numbers<float>(data, n * m);
    if (kind == "i8") array.values = numbers<std::int64_t>(data, n * m);
    if (kind == "i4") array.values = numbers<std::int32_t>(data, n * m);
    if (kind == "i2") array.values = numbers<std::int16_t>(data, n * m);
    if (kind == "i1") array.values = numbers<std::int8_t>(data, n * m);
    if (kind == "u4") array.values = numbers<std::uint32_t>(data, n * m);
    if (kind == "u2") array.values = numbers<std::uint16_t>(data, n * m);
    if (kind == "u1") array.values = numbers<std::uint8_t>(data, n * m);
    if (array.values.empty()) fail("of another type");
    if (kind == "i8" && std::ranges::any_of(array.values, [](double v) { return std::fabs(v) >= 9007199254740992.0; }))
        fail("of whole numbers beyond 2^53");
    const bool by_column = head.find("'fortran_order': True") != std::string::npos;
    array.rows = std::max(n, m);
    array.columns = std::min(n, m);
    array.rows_follow = (n >= m) != by_column;
    if (array.columns > 1000) fail("of more than 1000 columns");
    return table_of_arrays(path, "a NumPy array", {std::move(array)});
}

ForeignTable doubles_table_of(const std::string& path) {
    const std::string bytes = bytes_of(path);
    std::vector<double> values = numbers<double>(bytes, bytes.size() / sizeof(double));
    const std::size_t width = width_of(values);
    if (width == 0)
        throw FormatError(fmt::format(
            "{}: doubles without a header, and no column of times shows how many make a row; allowed are rows of 2..{} "
            "numbers, the first or the last of which rises evenly",
            path, max_width));
    ForeignArray array{
        .name = {}, .unit = {}, .rows = values.size() / width, .columns = width, .values = {}, .not_plain = {}};
    array.values = std::move(values);
    ForeignTable table =
        table_of_arrays(path, fmt::format("doubles without a header, {} to a row", width), {std::move(array)});
    if (width == 7 && path.ends_with(".imu") && rises_as_time(table.columns.back().values))
        table.notes.push_back(
            "as PSINS writes it, columns 1..3 are increments of angle in rad, 4..6 of velocity, 7 the times in s");
    return table;
}

}  // namespace zlg::logs
