#pragma once
// Which field of a row holds which column.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace zlg::logs {

struct Column {
    std::string_view name;
    bool required = true;
    const char* unit = "1";  // attribute of the HDF5 data set
};

struct ColumnMap {
    std::vector<std::optional<std::size_t>> field_of;  // field_of[column]; empty where the log has no such column
    std::vector<std::string> warnings;                 // unknown names, which are ignored
};

// `place` begins the messages: path and line of the names.
//
// errors  FormatError: a name twice, a name within two letters of a known one, a required column that is missing.
[[nodiscard]] ColumnMap map_columns(std::span<const Column> columns, const std::vector<std::string>& names,
                                    const std::string& place);

}  // namespace zlg::logs
