#include "column_map.hpp"

#include <fmt/format.h>

#include <zlg/logs/error.hpp>
#include <zlg/text/spelling.hpp>

namespace zlg::logs {

namespace {

// A typing mistake in an optional column would otherwise drop it with no more than a warning.
constexpr std::size_t misspelt_letters = 2;

// Each that is not known is named in a warning.
constexpr std::size_t max_names = 1000;

void refuse_misspelt(std::span<const KnownColumn> columns, const std::string& name, const std::string& place) {
    const auto apart = [&](const KnownColumn& column) { return text::letters_apart(name, column.name); };
    const KnownColumn& nearest =
        *std::min_element(columns.begin(), columns.end(),
                          [&](const KnownColumn& a, const KnownColumn& b) { return apart(a) < apart(b); });
    if (apart(nearest) <= misspelt_letters) {
        throw FormatError(fmt::format("{}: unknown column '{}'; did you mean '{}'?", place, name, nearest.name));
    }
}

void refuse_missing(std::span<const KnownColumn> columns, const ColumnMap& map, const std::string& place) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
        if (!columns[i].is_required || map.field_of[i]) continue;
        throw FormatError(fmt::format("{}: the column '{}' is missing", place, columns[i].name));
    }
}

// The current of the coil, of raw logs up to format_version 2.
constexpr std::string_view former_column = "coil_ua";

}  // namespace

ColumnMap map_columns(std::span<const KnownColumn> columns, const std::vector<std::string>& names,
                      const std::string& place) {
    if (names.size() > max_names)
        throw FormatError(fmt::format("{}: {} columns; a log has {} at most", place, names.size(), max_names));
    ColumnMap map;
    map.field_of.resize(columns.size());
    for (std::size_t field = 0; field < names.size(); ++field) {
        const std::string& name = names[field];
        if (std::find(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(field), name) !=
            names.begin() + static_cast<std::ptrdiff_t>(field)) {
            throw FormatError(fmt::format("{}: the column '{}' stands there twice", place, name));
        }
        const auto known = std::find_if(columns.begin(), columns.end(),
                                        [&](const KnownColumn& column) { return column.name == name; });
        if (known != columns.end()) {
            map.field_of[static_cast<std::size_t>(known - columns.begin())] = field;
        } else {
            refuse_misspelt(columns, name, place);
            const char* kind = name == former_column ? "column of a former version" : "unknown column";
            map.warnings.push_back(fmt::format("{}: the {} '{}' is ignored", place, kind, name));
        }
    }
    refuse_missing(columns, map, place);
    return map;
}

}  // namespace zlg::logs
