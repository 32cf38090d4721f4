#pragma once
// Rows of a CSV log as checked numbers; every complaint names path, line, row, column, value and what is allowed.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <zlg/logs/settings.hpp>

#include "column_map.hpp"
#include "line_reader.hpp"
#include "text_fields.hpp"

namespace zlg::logs {

// `columns` are the known ones; a column is named by its index in them. They must outlive the reader.
class CsvReader {
public:
    // errors  IoError, FormatError (see read_head and map_columns; no rows).
    CsvReader(const std::string& path, std::span<const KnownColumn> columns);

    [[nodiscard]] const Settings& settings() const { return settings_; }
    [[nodiscard]] const std::vector<std::string>& warnings() const { return map_.warnings; }
    [[nodiscard]] bool has(std::size_t column) const { return map_.field_of[column].has_value(); }

    // Moves to the next row; false at the end. errors FormatError: too few or too many fields, an empty line between
    // rows.
    bool next();

    // False where the row that was read last is the file's last line and has no end.
    [[nodiscard]] bool line_is_ended() const { return lines_.terminated(); }

    [[nodiscard]] double fraction_read() const { return lines_.fraction_read(); }

    // The value of a column of this row. errors  FormatError: it is no number, or the rule does not allow it.
    template <class T, class Rule> [[nodiscard]] T value(std::size_t column, const Rule& rule) const {
        if constexpr (std::is_integral_v<T>) {
            const std::optional<std::int64_t> number = integer(column);
            if (!number) fail_integer(column, rule.allowed());
            if (!rule.allows(*number, row_ - 1)) fail(column, rule.fault(*number, row_ - 1));
            return static_cast<T>(*number);
        } else {
            const std::optional<double> number = real(column);
            if (!number) fail(column, "is not a number; allowed is " + rule.allowed());
            if (!rule.allows(*number, row_ - 1)) fail(column, rule.fault(*number, row_ - 1));
            return *number;
        }
    }

    // Complains of a column of this row.
    [[noreturn]] void fail(std::size_t column, std::string_view what) const;

private:
    [[nodiscard]] std::string_view field(std::size_t column) const { return fields_[*map_.field_of[column]].text; }
    [[nodiscard]] std::optional<std::int64_t> integer(std::size_t column) const;
    [[noreturn]] void fail_integer(std::size_t column, const std::string& allowed) const;
    [[nodiscard]] std::optional<double> real(std::size_t column) const;
    [[nodiscard]] std::string place() const;
    void split(std::string_view line);
    void expect_only_empty_lines();

    LineReader lines_;
    std::span<const KnownColumn> columns_;
    Settings settings_;
    ColumnMap map_;
    std::size_t n_fields_ = 0;   // of the header
    std::vector<Field> fields_;  // of this row, as many
    char separator_ = ',';
    mutable Mark mark_ = Mark::none;  // the decimal mark, where it may be a comma
    std::int64_t row_ = 0;            // the first row is 1
};

}  // namespace zlg::logs
