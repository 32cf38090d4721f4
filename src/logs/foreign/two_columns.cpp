// Times of which the seconds stand in one column and the rest in the next, as ROS writes them.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <zlg/logs/row_times.hpp>
#include <zlg/text/spelling.hpp>

#include "foreign_readers.hpp"
#include "text_table/time_names.hpp"

namespace zlg::logs {

namespace {

// The last word of the name, in small letters.
std::string last_word(const std::string& name) {
    const std::string small = text::lower_case(name);
    const std::size_t end = small.find_last_not_of(" ])");
    const std::size_t at = small.find_last_of("._/[( ", end);
    return small.substr(at == std::string::npos ? 0 : at + 1, end == std::string::npos ? 0 : end - (at + 1) + 1);
}

// How many of the last word of the name make a second; 0: it is no unit.
double unit_behind(const std::string& name) { return time_unit(last_word(name)).value_or(0.0); }

bool all_whole(const std::vector<double>& values) {
    return std::ranges::all_of(values, [](double v) { return v >= 0.0 && v == std::floor(v); });
}

// What is taken off, the first second, for a double holds no nanoseconds since 1970.
template <class Values> double join(Values& whole, const Values& part, double parts) {
    const double first = whole.empty() ? 0.0 : whole.front();
    Values both;
    for (std::size_t k = 0; k < whole.size(); ++k) both.push_back(whole[k] - first + part[k] / parts);
    whole = std::move(both);
    return first;
}

// How many of `part` make one of `whole`: by the names of both, or where it falls when the other rises and comes near
// to so many. 0: they are no such pair.
double parts_in(const ForeignColumn& whole, const ForeignColumn& part) {
    if (!whole.is_number || !part.is_number || whole.values.size() < 3) return 0.0;
    if (!all_whole(whole.values) || !all_whole(part.values) ||
        !std::is_sorted(whole.values.begin(), whole.values.end()))
        return 0.0;
    const double most = *std::max_element(part.values.begin(), part.values.end());
    double parts = unit_behind(whole.name) == 1.0 ? unit_behind(part.name) : 0.0;
    if (parts < 1e3 && !std::is_sorted(part.values.begin(), part.values.end()))
        for (const double some : {1e3, 1e6, 1e9})
            if (most < some && most > some / 2.0) parts = some;
    if (parts < 1e3 || most >= parts) return 0.0;
    std::vector<double> times = whole.values;
    (void)join(times, part.values, parts);
    return std::is_sorted(times.begin(), times.end()) && times.front() < times.back() ? parts : 0.0;
}

}  // namespace

void join_seconds(ForeignTable& table) {
    for (std::size_t c = 0; c + 1 < table.columns.size(); ++c) {
        ForeignColumn &whole = table.columns[c], &part = table.columns[c + 1];
        const double parts = parts_in(whole, part);
        if (parts == 0.0) continue;
        whole.is_part = part.is_part = true;
        ForeignColumn both{.number = std::ssize(table.columns) + 1,
                           .name = fmt::format("time of columns {} and {} [s]", c + 1, c + 2),
                           .first = fmt::format("{} + {}/{:g}", whole.first, part.first, parts),
                           .values = whole.values};
        (void)join(both.values, part.values, parts);
        table.read = [read = std::move(table.read), number = both.number, name = both.name, parts,
                      first = whole.number](std::vector<std::int64_t> wanted, std::int64_t times) {
            if (times != number) return read(wanted, times);
            wanted.insert(wanted.end(), {first, first + 1});
            TextTable all = read(wanted, 0);
            const TextColumn part_read = std::move(all.columns.back());
            all.columns.pop_back();
            all.times = std::move(all.columns.back());
            all.columns.pop_back();
            all.times->origin = join(all.times->values, part_read.values, parts);
            all.times->number = number;
            all.times->name = name;
            return all;
        };
        table.columns.push_back(std::move(both));
        return;
    }
}

}  // namespace zlg::logs
