#pragma once
// Rows of a CSV log as checked numbers; every complaint names path, line, row, column, value and what is allowed.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "column_map.hpp"
#include "csv_head.hpp"
#include "line_reader.hpp"
#include "text_fields.hpp"

namespace zlg::logs {

// `columns` are the known ones; a column is named by its index in them. They must outlive the reader.
class CsvReader {
public:
    // errors  IoError, FormatError (see read_head and map_columns; no rows).
    CsvReader(const std::string& path, std::span<const Column> columns);

    [[nodiscard]] const Settings& settings() const { return settings_; }
    [[nodiscard]] const std::vector<std::string>& warnings() const { return map_.warnings; }
    [[nodiscard]] bool has(std::size_t column) const { return map_.field_of[column].has_value(); }

    // Moves to the next row; false at the end. errors FormatError: too few or too many fields, an empty line between
    // rows.
    bool next();

    // False where the row that was read last is the file's last line and has no end.
    [[nodiscard]] bool line_is_ended() const { return lines_.terminated(); }

    [[nodiscard]] double fraction_read() const { return lines_.fraction_read(); }

    // Values of this row. errors FormatError.
    [[nodiscard]] std::int64_t integer(std::size_t column, std::int64_t min, std::int64_t max) const;
    [[nodiscard]] std::int8_t sign(std::size_t column) const;  // +1 or -1
    [[nodiscard]] bool flag(std::size_t column) const;         // 0 or 1
    [[nodiscard]] double real(std::size_t column) const;       // finite
    [[nodiscard]] double real_or_infinite(std::size_t column) const;

    // Complains of a column of this row.
    [[noreturn]] void fail(std::size_t column, std::string_view what) const;

private:
    [[nodiscard]] std::string_view field(std::size_t column) const { return fields_[*map_.field_of[column]]; }
    [[noreturn]] void fail_integer(std::size_t column, std::string_view allowed) const;
    [[nodiscard]] double any_real(std::size_t column) const;
    [[nodiscard]] std::string place() const;
    void split(std::string_view line);
    std::size_t split_fields_of(std::string_view line);
    void expect_only_empty_lines();

    LineReader lines_;
    std::span<const Column> columns_;
    Settings settings_;
    ColumnMap map_;
    std::vector<std::string_view> fields_;  // of this row; as many as the header names
    std::vector<Field> quoted_fields_;
    char separator_ = ',';
    mutable Mark mark_ = Mark::none;  // the decimal mark, where it may be a comma
    std::int64_t row_ = 0;            // the first row is 1
};

}  // namespace zlg::logs
