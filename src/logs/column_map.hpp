#pragma once
// Which field of a row holds which column.

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <zlg/logs/table_column.hpp>

namespace zlg::logs {

struct KnownColumn {
    std::string_view name;
    bool is_required = true;
};

template <class Table>
inline constexpr auto known_columns = [] {
    std::array<KnownColumn, n_columns<Table>> columns;
    for_each_column<Table>([&](const auto& field, std::size_t k) { columns[k] = {field.name, !field.is_optional}; });
    return columns;
}();

// The place of a column in its table.
template <class Table> constexpr std::size_t column_named(std::string_view name) {
    const auto found = std::find_if(known_columns<Table>.begin(), known_columns<Table>.end(),
                                    [name](const KnownColumn& column) { return column.name == name; });
    return static_cast<std::size_t>(found - known_columns<Table>.begin());
}

struct ColumnMap {
    std::vector<std::optional<std::size_t>> field_of;  // field_of[column]; empty where the log has no such column
    std::vector<std::string> warnings;                 // unknown names, which are ignored
};

// `place` begins the messages: path and line of the names.
//
// errors  FormatError: a name twice, a name within two letters of a known one, a required column that is missing.
[[nodiscard]] ColumnMap map_columns(std::span<const KnownColumn> columns, const std::vector<std::string>& names,
                                    const std::string& place);

}  // namespace zlg::logs
