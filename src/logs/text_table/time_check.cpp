#include <zlg/logs/time_check.hpp>

#include <fmt/format.h>

#include "time_names.hpp"

namespace zlg::logs {

namespace {

std::string other_columns(const TextTable& table) {
    std::string names;
    for (std::size_t k = 1; k < table.names.size(); ++k)
        if (!table.names[k].empty()) names += fmt::format("{}'{}'", names.empty() ? "" : ", ", table.names[k]);
    if (table.n_columns == 2) return fmt::format("column 2{}{}", names.empty() ? "" : ", ", names);
    if (names.empty()) return fmt::format("columns 2..{}", table.n_columns);
    return fmt::format("columns {}", names);
}

}  // namespace

std::string mistaken_times(const TextTable& table, const std::string& path, const TextLayout& layout,
                           bool column_is_said, const std::string& noun) {
    if (column_is_said) return {};
    const TextColumn& column = table.columns.front();
    if (!names_time(column.name) && !rises_as_time(column.values)) return {};
    const std::string head = fmt::format("{0}.column is not set: {1}, {2} rises as times do and is no {3}; ",
                                         layout.section, path, described(column), noun);
    if (table.n_columns < 2) return head + fmt::format("{}.column = 1 if it is, for there is no other", layout.section);
    return head + fmt::format("say which {0}.column it is, of {1}, or 1 if it is that one", layout.section,
                              other_columns(table));
}

TimeCheck check_times(const TextTable& table, const std::string& path, const TextLayout& layout,
                      std::optional<double> rate_hz) {
    TimeCheck check;
    if (!table.times) return check;
    check.times = row_times(*table.times, path, !layout.time_column.empty());
    if (!check.times || !rate_hz) return check;
    const std::string why = contradiction(*table.times, *check.times, *rate_hz);
    if (!why.empty())
        check.contradiction = fmt::format("{0}.rate_hz = {1}: {2}, {3}; {0}.time_column = 0 leaves it out",
                                          layout.section, *rate_hz, path, why);
    const std::string unit = presumed_unit(*table.times, *check.times, *rate_hz);
    if (!unit.empty())
        check.presumption = fmt::format("{}, {}, but {}.rate_hz = {}: read as {}, which its name does not say", path,
                                        rate_in_words(*table.times, *check.times), layout.section, *rate_hz, unit);
    return check;
}

std::string missing_in_words(const TextTable& table, const std::string& path, const RowTimes& times) {
    return fmt::format("{}, {}: {} rows are missing in {} place{}, the first after row {}", path,
                       described(*table.times), times.n_missing, times.holes.size(), times.holes.size() == 1 ? "" : "s",
                       times.holes.front().row + 1);
}

}  // namespace zlg::logs
