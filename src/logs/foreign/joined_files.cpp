// Files of one record, one after the other.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <zlg/logs/imported.hpp>

#include "row_clock.hpp"

namespace zlg::logs {

namespace {

void append(LongColumn& to, const LongColumn& values, double shift) {
    for (const double value : values) to.push_back(value + shift);
}

// errors  MappingError: its times begin before those of the rows before it have ended.
void append(TextTable& to, const TextTable& more, const std::string& path) {
    if (to.times) {
        double shift = more.times->origin - to.times->origin;
        // As within a file: what goes on by less.
        const double end = to.times->values.back() - more.times->values.front();
        if (const double other = more.times->other_origin - to.times->other_origin;
            more.times->holds_dates && std::fabs(other - end) < std::fabs(shift - end))
            shift = other;
        const bool is_absolute = more.times->holds_dates || more.times->origin != 0.0;
        if (is_absolute && more.times->values.front() + shift <= to.times->values.back())
            throw MappingError(
                fmt::format("{}, {}: begins before the file before it has ended; allowed are files in the "
                            "order of their times",
                            path, described(*more.times)));
        // A clock of each file's own says nothing of the time between them.
        if (!is_absolute && more.times->values.front() == to.times->values.front())
            throw MappingError(
                fmt::format("{}, {}: begins with {} as that of the first file; allowed are times of one "
                            "clock, or --map time=none with rate_hz if no rows are missing between them",
                            path, described(*more.times), more.times->values.front()));
        append(to.times->values, more.times->values, shift);
    }
    for (std::size_t c = 0; c < to.columns.size(); ++c) append(to.columns[c].values, more.columns[c].values, 0.0);
}

}  // namespace

ForeignLook look_at_foreign(const std::vector<std::string>& paths, const Mapping& said) {
    ForeignLook look = look_at_foreign(paths.front(), said);
    if (paths.size() == 1) return look;
    const auto all = std::make_shared<std::vector<ForeignTable>>();
    for (const std::string& path : paths) {
        all->push_back(foreign_table(path, said));
        const ForeignTable& table = all->back();
        if (!std::ranges::equal(table.columns, look.table.columns, {}, &ForeignColumn::name, &ForeignColumn::name))
            throw MappingError(fmt::format("{}: its columns are not those of {}; allowed are files of one record", path,
                                           paths.front()));
        if (look.table.n_rows && &table != all->data()) *look.table.n_rows += table.n_rows.value_or(0);
    }
    look.table.read = [all](const std::vector<std::int64_t>& wanted, std::int64_t times) {
        TextTable joined = all->front().read(wanted, times);
        for (const ForeignTable& table : std::span{*all}.subspan(1))
            append(joined, table.read(wanted, times), table.path);
        return joined;
    };
    look.said.push_back(fmt::format("{} files are one record", paths.size()));
    if (time_column(look.table, look.mapping) == 0)
        look.said.emplace_back("nothing says whether rows are missing between them: neither times nor numbers of rows");
    return look;
}

}  // namespace zlg::logs
