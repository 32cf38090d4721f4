#pragma once
// One reader a kind of file. Each throws what foreign_table() throws.

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include <zlg/logs/foreign_table.hpp>

namespace zlg::logs {

[[nodiscard]] ForeignTable text_table_of(const std::string& path, const Mapping& mapping);
[[nodiscard]] ForeignTable hdf5_table_of(const std::string& path, const Mapping& mapping);
[[nodiscard]] ForeignTable matlab5_table_of(const std::string& path, const Mapping& mapping);
[[nodiscard]] ForeignTable numpy_table_of(const std::string& path);
[[nodiscard]] ForeignTable doubles_table_of(const std::string& path);
[[nodiscard]] ForeignTable bag_table_of(const std::string& path, const Mapping& mapping);

// An array of a file that holds some.
struct ForeignArray {
    std::string name;
    std::string unit;      // empty: not said
    std::size_t rows = 0;  // of a matrix the longer side
    std::size_t columns = 1;
    bool may_be_rounded = false;   // whole numbers of 8 bytes
    std::size_t rows_at_once = 1;  // to be read together, or multiples of them
    // Rows from the one of index `from` on, one column behind the other. `is_used`: numbers are made of them, and must
    // be what they stand for.
    //
    // errors  IoError; FormatError: damaged, or, used, scaled by an attribute.
    std::function<std::vector<double>(std::size_t from, std::size_t n_rows, bool is_used)> read;
};

// Adds a column of the times whose seconds and fractions stand in two; the first such pair.
void join_seconds(ForeignTable& table);

// Values row by row as ForeignArray::read gives them.
[[nodiscard]] std::vector<double> by_columns(std::vector<double> by_rows, std::size_t columns);

// A matrix whose shorter side is longer is none of a record.
inline constexpr std::size_t max_matrix_columns = 1000;

// The arrays of the commonest length as columns; the others are left out with a note, before `notes` of what the reader
// left out itself.
//
// errors  MappingError: two lengths are equally common; FormatError: no array.
[[nodiscard]] ForeignTable table_of_arrays(const std::string& path, const std::string& nature,
                                           std::vector<ForeignArray> arrays,
                                           const std::vector<std::string>& notes = {});

}  // namespace zlg::logs
