#include "matlab5_file.hpp"

#include <concepts>
#include <cstring>
#include <type_traits>
#include <vector>

namespace zlg::logs {
namespace {

// Types of data, and classes of matrices, as MATLAB numbers them.
enum DataType : std::uint32_t {
    type_int8 = 1,
    type_uint8 = 2,
    type_uint16 = 4,
    type_int32 = 5,
    type_uint32 = 6,
    type_single = 7,
    type_double = 9,
    type_matrix = 14
};
enum MatrixClass : std::uint32_t { class_char = 4, class_double = 6 };

template <class Number> constexpr DataType type_of() {
    if constexpr (std::same_as<Number, std::int8_t>) return type_int8;
    if constexpr (std::same_as<Number, std::uint8_t>) return type_uint8;
    if constexpr (std::same_as<Number, std::int32_t>) return type_int32;
    if constexpr (std::same_as<Number, std::uint32_t>) return type_uint32;
    if constexpr (std::same_as<Number, float>) return type_single;
    if constexpr (std::same_as<Number, double>) return type_double;
}

constexpr std::size_t padded(std::size_t bytes) { return (bytes + 7) / 8 * 8; }

template <class Number> std::string_view bytes_of(std::span<const Number> values) {
    return {reinterpret_cast<const char*>(values.data()), values.size_bytes()};
}

std::string tag(std::uint32_t type, std::size_t bytes) {
    const std::uint32_t words[]{type, static_cast<std::uint32_t>(bytes)};
    return std::string{bytes_of(std::span<const std::uint32_t>{words})};
}

// A piece of data behind its tag, up to the next multiple of eight bytes.
std::string element(std::uint32_t type, std::string_view data) {
    std::string made = tag(type, data.size());
    made += data;
    made.resize(padded(made.size()), '\0');
    return made;
}

std::vector<std::uint16_t> utf16(std::string_view utf8) {
    std::vector<std::uint16_t> units;
    for (std::size_t k = 0; k < utf8.size();) {
        const auto byte = [&](std::size_t at) {
            return static_cast<unsigned char>(at < utf8.size() ? utf8[at] : '\0');
        };
        const unsigned first = byte(k);
        const std::size_t more = first < 0x80 ? 0 : first < 0xE0 ? 1 : first < 0xF0 ? 2 : 3;
        std::uint32_t point = more == 0 ? first : first & (0x3Fu >> more);
        for (std::size_t m = 1; m <= more; ++m) point = point << 6 | (byte(k + m) & 0x3Fu);
        k += 1 + more;
        if (point < 0x10000) {
            units.push_back(static_cast<std::uint16_t>(point));
        } else {
            units.push_back(static_cast<std::uint16_t>(0xD800u + ((point - 0x10000) >> 10)));
            units.push_back(static_cast<std::uint16_t>(0xDC00u + ((point - 0x10000) & 0x3FFu)));
        }
    }
    return units;
}

}  // namespace

Matlab5File::Matlab5File(const std::string& path, bool force) : file_{path, force} {
    std::string head{"MATLAB 5.0 MAT-file, written by zlg"};
    head.resize(116, ' ');
    head.resize(124, '\0');
    // Version, and by the order of the letters the order of bytes.
    const std::uint16_t version[]{0x0100, 0x4D49};
    file_.append(head);
    file_.append(bytes_of(std::span<const std::uint16_t>{version}));
}

template <class Number> void Matlab5File::add(std::string_view name, std::span<const Number> values, std::size_t rows) {
    add_matrix(name, class_double, rows, rows == 0 ? 0 : values.size() / rows, type_of<Number>(), bytes_of(values));
}

template void Matlab5File::add(std::string_view, std::span<const std::int8_t>, std::size_t);
template void Matlab5File::add(std::string_view, std::span<const std::uint8_t>, std::size_t);
template void Matlab5File::add(std::string_view, std::span<const std::int32_t>, std::size_t);
template void Matlab5File::add(std::string_view, std::span<const std::uint32_t>, std::size_t);
template void Matlab5File::add(std::string_view, std::span<const float>, std::size_t);
template void Matlab5File::add(std::string_view, std::span<const double>, std::size_t);

void Matlab5File::add_text(std::string_view name, std::string_view utf8) {
    const std::vector<std::uint16_t> units = utf16(utf8);
    add_matrix(name, class_char, units.empty() ? 0 : 1, units.size(), type_uint16,
               bytes_of(std::span<const std::uint16_t>{units}));
}

void Matlab5File::add_matrix(std::string_view name, std::uint32_t matrix_class, std::size_t rows, std::size_t columns,
                             std::uint32_t type, std::string_view data) {
    const std::uint32_t flags[]{matrix_class, 0};
    const std::int32_t size[]{static_cast<std::int32_t>(rows), static_cast<std::int32_t>(columns)};
    const std::string head = element(type_uint32, bytes_of(std::span<const std::uint32_t>{flags})) +
                             element(type_int32, bytes_of(std::span<const std::int32_t>{size})) +
                             element(type_int8, name) + tag(type, data.size());
    file_.append(tag(type_matrix, head.size() + padded(data.size())));
    file_.append(head);
    // In pieces, for the file holds each in memory once more.
    constexpr std::size_t piece = std::size_t{1} << 20;
    for (std::size_t at = 0; at < data.size(); at += piece) file_.append(data.substr(at, piece));
    file_.append(std::string(padded(data.size()) - data.size(), '\0'));
}

}  // namespace zlg::logs
