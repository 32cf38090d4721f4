#pragma once
// One reader a kind of file. Each throws what foreign_table() throws.

#include <string>
#include <vector>

#include <zlg/logs/foreign_table.hpp>

namespace zlg::logs {

[[nodiscard]] ForeignTable text_table_of(const std::string& path, const Mapping& mapping);
[[nodiscard]] ForeignTable hdf5_table_of(const std::string& path, const Mapping& mapping);
[[nodiscard]] ForeignTable matlab5_table_of(const std::string& path, const Mapping& mapping);
[[nodiscard]] ForeignTable numpy_table_of(const std::string& path);
[[nodiscard]] ForeignTable doubles_table_of(const std::string& path);

// The whole file. errors  IoError; FormatError: more bytes than can be read.
[[nodiscard]] std::string bytes_of(const std::string& path);

// Arrays of a file that holds some, as they lie in memory.
struct ForeignArray {
    std::string name;
    std::string unit;      // empty: not said
    std::size_t rows = 0;  // of a matrix the longer side
    std::size_t columns = 1;
    bool rows_follow = true;  // the values of a row lie side by side; else those of a column do
    std::vector<double> values;
    std::string not_plain;  // as in ForeignColumn
};

// The arrays of the commonest length as columns; the others are left out with a note.
//
// errors  MappingError: two lengths are equally common; FormatError: no array.
[[nodiscard]] ForeignTable table_of_arrays(const std::string& path, const std::string& nature,
                                           std::vector<ForeignArray> arrays);

// More values than a file that one can wait for.
inline constexpr std::size_t max_foreign_values = std::size_t{1} << 28;

}  // namespace zlg::logs
