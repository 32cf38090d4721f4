// Times as a file writes them: counters that begin anew, messages that stand twice.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>
#include <zlg/logs/error.hpp>

#include "row_clock.hpp"
#include "text_table/steps.hpp"

namespace zlg::logs {

namespace {

// Of all ranges after which times and counters begin anew, in rising order.
std::vector<double> ranges(bool of_whole) {
    std::vector<double> all{360.0, 1e9};
    for (const double second : {1.0, 1e3, 1e6, 1e9})
        for (const double circle : {3600.0, 43200.0, 86400.0, 604800.0}) all.push_back(circle * second);
    if (of_whole) {
        for (int bits = 7; bits <= 32; ++bits) all.push_back(std::ldexp(1.0, bits));
        for (const double decade : {1e3, 1e4, 1e5, 1e6}) all.push_back(decade);
    }
    std::sort(all.begin(), all.end());
    return all;
}

// A row that comes far sooner than one does, where the next one does not come later for it.
bool is_again(const LongColumn& t, std::size_t k, double usual) {
    constexpr double soon = 0.1;
    const double step = t[k] - t[k - 1];
    const auto is_a_row = [usual](double step_of_two) { return std::fabs(step_of_two / usual - 1.0) < 0.5; };
    return step > 0.0 && step < soon * usual && (k < 2 || is_a_row(t[k] - t[k - 2])) &&
           (k + 1 == t.size() || is_a_row(t[k + 1] - t[k - 1]));
}

}  // namespace

double begin_of_range(const LongColumn& values, double origin) {
    std::vector<double> falls;
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (std::size_t k = 0; k < values.size(); ++k) {
        if (!std::isfinite(values[k])) return 0.0;
        least = std::min(least, values[k]);
        most = std::max(most, values[k]);
        if (k > 0 && values[k] < values[k - 1]) falls.push_back(values[k] - values[k - 1]);
    }
    if (falls.empty() || 4 * falls.size() > values.size()) return 0.0;
    const double usual = usual_step(values);
    if (!(usual > 0.0)) return 0.0;
    for (const double range : ranges(std::ranges::all_of(values, [](double v) { return v == std::floor(v); }))) {
        const bool fits =
            (least + origin >= 0.0 && most + origin <= range) || (-least <= range / 2.0 && most <= range / 2.0);
        if (!fits) continue;
        const auto n_plain =
            std::ranges::count_if(falls, [&](double fall) { return std::fabs(fall + range - usual) <= usual / 2.0; });
        const bool all_rise =
            std::ranges::all_of(falls, [&](double fall) { return fall + range > 0.0 && fall + range < range / 2.0; });
        // A record that was begun anew falls by anything.
        if (all_rise && 2 * n_plain > std::ssize(falls)) return range;
    }
    return 0.0;
}

double go_on(LongColumn& values, double origin) {
    const double range = begin_of_range(values, origin);
    if (range == 0.0) return 0.0;
    double turns = 0.0, last = -std::numeric_limits<double>::infinity();
    values.change([&](double value) {
        if (value + turns < last) turns += range;
        return last = value + turns;
    });
    return range;
}

std::vector<std::string> settle_times(TextTable& read) {
    // A date never begins anew, a time of the day does.
    constexpr double day_s = 86400.0;
    if (!read.times || (read.times->holds_dates && read.times->origin > day_s)) return {};
    const double range = go_on(read.times->values, read.times->origin);
    if (range == 0.0) return {};
    return {
        fmt::format("{}: begins anew after {:.10g}, and is read as going on; rows that are missing are not seen "
                    "where they fill that range",
                    described(*read.times), range)};
}

void refuse_clock_digits(const TextColumn& times, const RowTimes& found, const std::string& path) {
    // One full minute may be a cut at round seconds, unless hours stand before it.
    constexpr double with_hours = 10000.0, of_a_day = 240000.0;
    constexpr double hidden_s = 40.0;  // from 59 to 100
    const double first = times.values.front();
    const std::size_t fewest = first < with_hours || first >= of_a_day ? 2 : 1;
    if (found.holes.size() < fewest || times.holds_dates || found.step >= hidden_s) return;
    const bool are_minutes = std::ranges::all_of(found.holes, [&](const Hole& hole) {
        const double before = std::fmod(times.values[hole.row], 100.0), after = times.values[hole.row + 1];
        return before < 60.0 && before + found.step > 59.5 && std::fmod(after, 100.0) < 1.5 * found.step;
    });
    if (!are_minutes) return;
    const std::size_t row = found.holes.front().row;
    throw FormatError(fmt::format(
        "{}, {}: jumps from {} to {} as hours, minutes and seconds in one number do; allowed are seconds, or "
        "--map time=none with rate_hz",
        path, described(times), times.values[row], times.values[row + 1]));
}

void leave_out(TextTable& read, const std::vector<std::size_t>& rows) {
    const auto thin = [&rows](LongColumn& values) {
        std::size_t next = 0;
        LongColumn thinned;
        for (std::size_t k = 0; k < values.size(); ++k)
            if (next < rows.size() && rows[next] == k)
                ++next;
            else
                thinned.push_back(values[k]);
        values = std::move(thinned);
    };
    thin(read.times->values);
    for (TextColumn& column : read.columns) thin(column.values);
}

std::vector<std::string> take_once(TextTable& read, const std::string& path) {
    if (!read.times || read.times->values.size() < 4) return {};
    const LongColumn& t = read.times->values;
    const double usual = usual_step(t, 0.75);
    std::vector<std::size_t> again;
    bool are_same = true;
    for (std::size_t k = 1; k < t.size(); ++k) {
        if (!is_again(t, k, usual)) continue;
        again.push_back(k);
        are_same = are_same && std::ranges::all_of(read.columns, [k](const TextColumn& column) {
                       return column.values[k] == column.values[k - 1];
                   });
    }
    if (again.empty()) return {};
    const double apart = t[again.front()] - t[again.front() - 1];
    const std::string what = fmt::format(
        "{}: {} row{} come{} {:.3g} behind the row before, where rows are {:.6g} apart", described(*read.times),
        again.size(), again.size() == 1 ? "" : "s", again.size() == 1 ? "s" : "", apart, usual);
    if (!are_same)
        throw FormatError(fmt::format(
            "{}, {}, the first in row {}, with other values; allowed are messages that stand once, or --map time=none "
            "with rate_hz",
            path, what, again.front() + 1));
    leave_out(read, again);
    return {what + ", with its values, and are left out"};
}

}  // namespace zlg::logs
