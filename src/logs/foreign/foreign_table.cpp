#include <zlg/logs/foreign_table.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <zlg/logs/budget.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/logs/file_nature.hpp>
#include <zlg/text/escape.hpp>
#include <zlg/text/spelling.hpp>

#include "foreign_readers.hpp"

namespace zlg::logs {

namespace {

constexpr std::size_t most_at_once = std::size_t{1} << 16;  // numbers

// A name without the unit behind it.
std::string_view bare(std::string_view name) {
    const std::size_t open = name.find_first_of("[(");
    if (open == std::string_view::npos || open == 0) return name;
    return name.substr(0, name.find_last_not_of(" \t", open - 1) + 1);
}

std::string all_columns(const ForeignTable& table) {
    std::string all;
    for (const ForeignColumn& column : table.columns) {
        if (all.size() > 300) return all + ", ...";
        all += fmt::format("{}{}", all.empty() ? "" : ", ",
                           column.name.empty() ? fmt::format("{}", column.number)
                                               : fmt::format("'{}'", text::excerpt(column.name, 40, ' ')));
    }
    return all;
}

void add_columns(ForeignTable& table, const ForeignArray& array, std::size_t n_rows) {
    const std::vector<double> values = array.read(0, n_rows, false);
    for (std::size_t c = 0; c < array.columns; ++c) {
        ForeignColumn column{.number = std::ssize(table.columns) + 1, .name = array.name, .first = {}, .values = {}};
        if (array.columns > 1) column.name += fmt::format("{}{}", array.name.empty() ? "" : "_", c + 1);
        if (array.columns > 1 && array.name.empty()) column.name.clear();
        if (!array.unit.empty()) column.name += fmt::format(" [{}]", array.unit);
        const auto begin = values.begin() + static_cast<std::ptrdiff_t>(c * n_rows);
        column.values.assign(begin, begin + static_cast<std::ptrdiff_t>(n_rows));
        column.first = fmt::format("{}", column.values.front());
        table.columns.push_back(std::move(column));
    }
}

TextColumn empty_column(std::int64_t number, const std::vector<std::string>& names) {
    return {.number = number, .name = names[static_cast<std::size_t>(number - 1)], .values = {}};
}

void refuse_rounded(const std::string& path, const TextColumn& column, std::span<const double> values) {
    constexpr double exact_whole = 9007199254740992.0;  // 2^53
    for (const double v : values)
        if (std::fabs(v) >= exact_whole)
            throw FormatError(
                fmt::format("{}, {}: holds {:.17g}; allowed are whole numbers below 2^53", path, described(column), v));
}

// Each array is read once, some rows at a time.
void fill_columns(const std::string& path, TextTable& table, const std::vector<ForeignArray>& arrays) {
    std::size_t first = 0;  // column of the array, from 0
    for (const ForeignArray& array : arrays) {
        std::vector<TextColumn*> wanted;
        const auto want = [&](TextColumn& column) {
            const auto number = static_cast<std::size_t>(column.number - 1);
            if (number >= first && number < first + array.columns) wanted.push_back(&column);
        };
        for (TextColumn& column : table.columns) want(column);
        if (table.times) want(*table.times);
        const std::size_t together = (most_at_once / array.columns / array.rows_at_once + 1) * array.rows_at_once;
        for (std::size_t from = 0; from < array.rows && !wanted.empty(); from += together) {
            const std::size_t n = std::min(together, array.rows - from);
            const std::vector<double> read = array.read(from, n, true);
            for (TextColumn* column : wanted) {
                const auto at = (static_cast<std::size_t>(column->number - 1) - first) * n;
                const auto values = std::span{read}.subspan(at, n);
                // Times that are rounded still say how the rows lie.
                if (array.may_be_rounded && !(table.times && column == &*table.times))
                    refuse_rounded(path, *column, values);
                for (const double value : values) column->values.push_back(value);
            }
        }
        first += array.columns;
    }
}

std::string count_of(std::size_t n, const char* one) { return fmt::format("{} {}{}", n, one, n == 1 ? "" : "s"); }

ForeignTable table_of(const std::string& path, const Mapping& mapping) {
    const std::string nature = foreign_nature(path);
    if (nature.starts_with("HDF5")) return hdf5_table_of(path, mapping);
    if (nature.starts_with("a MATLAB 5")) return matlab5_table_of(path, mapping);
    if (nature.starts_with("a NumPy array")) return numpy_table_of(path);
    if (nature.starts_with("binary numbers of 8 bytes")) return doubles_table_of(path);
    if (nature.starts_with("a ROS bag") || nature.starts_with("an MCAP")) return bag_table_of(path, mapping);
    if (!nature.empty())
        throw FormatError(fmt::format(
            "{}: is {}; allowed are text, HDF5, MATLAB, a NumPy array (.npy), MCAP, a ROS bag, or rows of doubles",
            path, nature));
    return text_table_of(path, mapping);
}

}  // namespace

ForeignTable foreign_table(const std::string& path, const Mapping& mapping) {
    ForeignTable table = table_of(path, mapping);
    join_seconds(table);
    return table;
}

std::string described(const ForeignColumn& column) {
    return column.name.empty() ? fmt::format("column {}", column.number)
                               : fmt::format("column {}, '{}'", column.number, text::excerpt(column.name, 60, ' '));
}

void refuse_words(const ForeignColumn& column) {
    if (!column.word.empty())
        throw FormatError(column.word + "; allowed is a finite number, or nan where it is missing");
}

const ForeignColumn& column_named(const ForeignTable& table, const std::string& name) {
    if (!name.empty() && name.find_first_not_of("0123456789") == std::string::npos && name.size() < 8) {
        const std::size_t number = std::stoul(name);
        if (number >= 1 && number <= table.columns.size()) return table.columns[number - 1];
        throw MappingError(fmt::format("{}: column {}; allowed is 1..{}", table.path, name, table.columns.size()));
    }
    // As it stands, else without its unit, else in other letters.
    const auto as_it_is = [](std::string_view text) { return std::string{text}; };
    const auto without_unit = [](std::string_view text) { return std::string{bare(text)}; };
    const auto in_small = [](std::string_view text) { return text::lower_case(bare(text)); };
    for (const std::function<std::string(std::string_view)>& form :
         {std::function<std::string(std::string_view)>{as_it_is}, {without_unit}, {in_small}}) {
        const auto is_it = [&](const ForeignColumn& c) { return !c.name.empty() && form(c.name) == form(name); };
        const auto n = std::ranges::count_if(table.columns, is_it);
        if (n > 1)
            throw MappingError(fmt::format("{}: two columns are named '{}'; give the number, 1..{}", table.path,
                                           text::excerpt(name, 60, ' '), table.columns.size()));
        if (n == 1) return *std::ranges::find_if(table.columns, is_it);
    }
    for (const std::string& note : table.notes)
        if (note.starts_with(fmt::format("'{}' is left out: ", text::excerpt(name, 60, ' '))))
            throw MappingError(fmt::format("{}: {}", table.path, note));
    throw MappingError(fmt::format("{}: no column '{}'; its columns are {}", table.path, text::excerpt(name, 60, ' '),
                                   all_columns(table)));
}

ForeignTable table_of_arrays(const std::string& path, const std::string& nature, std::vector<ForeignArray> arrays,
                             const std::vector<std::string>& notes) {
    if (arrays.empty() && !notes.empty())
        throw FormatError(fmt::format("{}: holds no array of numbers; {}", path, notes.front()));
    std::map<std::size_t, std::size_t> columns_of_length;
    for (const ForeignArray& array : arrays)
        if (array.rows > 1) columns_of_length[array.rows] += array.columns;
    if (columns_of_length.empty())
        throw FormatError(fmt::format("{}: holds no array of numbers of more than one row", path));
    const auto most = std::ranges::max_element(columns_of_length, {}, [](const auto& n) { return n.second; });
    for (const auto& [rows, n] : columns_of_length)
        if (n == most->second && rows != most->first)
            throw MappingError(fmt::format("{}: holds arrays of {} rows and of {} rows; say which by --map table=NAME",
                                           path, std::min(rows, most->first), std::max(rows, most->first)));
    ForeignTable table{.path = path,
                       .nature = nature,
                       .columns = {},
                       .notes = {},
                       .n_rows = static_cast<std::int64_t>(most->first),
                       .read = {}};
    std::size_t n_columns = 0;
    for (const ForeignArray& array : arrays) n_columns += array.rows == most->first ? array.columns : 0;
    const std::size_t n_looked_at = std::min(most->first, std::max<std::size_t>(max_looked_at / n_columns, 16));
    std::vector<ForeignArray> used;
    for (ForeignArray& array : arrays) {
        if (array.rows == most->first) {
            add_columns(table, array, n_looked_at);
            used.push_back(std::move(array));
        } else if (table.notes.size() < 10) {
            table.notes.push_back(fmt::format("'{}' is left out: it has {}, not {}", text::excerpt(array.name, 60, ' '),
                                              count_of(array.rows, "row"), most->first));
        }
    }
    std::vector<std::string> names;
    for (const ForeignColumn& column : table.columns) names.push_back(column.name);
    table.notes.insert(table.notes.end(), notes.begin(), notes.end());
    table.read = [path, used = std::move(used), names = std::move(names)](const std::vector<std::int64_t>& wanted,
                                                                          std::int64_t times) {
        TextTable read;
        for (const std::int64_t number : wanted) read.columns.push_back(empty_column(number, names));
        if (times > 0) read.times = empty_column(times, names);
        fill_columns(path, read, used);
        return read;
    };
    return table;
}

}  // namespace zlg::logs
