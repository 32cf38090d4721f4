#include "row_clock.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <zlg/logs/error.hpp>

#include "text_table/time_names.hpp"

namespace zlg::logs {

namespace {

[[noreturn]] void refuse(const std::string& path, const TextColumn& times, const std::string& why) {
    throw FormatError(fmt::format("{}, {}: {}", path, described(times), why));
}

// The step that has, or whose rate has, the fewest digits that the times allow, and that leaves the rate to a
// thousandth.
double simplest(double step_s, double allowed) {
    const double tolerance = std::min(allowed, 1e-3);
    const auto rounded = [](double value, int digits) {
        return std::strtod(fmt::format("{:.{}e}", value, digits - 1).c_str(), nullptr);
    };
    for (int digits = 1; digits < 17; ++digits)
        for (const double simple_s : {rounded(step_s, digits), 1.0 / rounded(1.0 / step_s, digits)})
            if (std::fabs(simple_s - step_s) <= tolerance * step_s) return simple_s;
    return step_s;
}

// The rows about a hole must be as far apart as their number says, the missing ones with them: stamps that come late
// after a pause of the program that wrote them look like a hole, and are none.
void check_holes(const TextColumn& times, const RowTimes& found, const std::string& path) {
    constexpr std::size_t reach = 12;
    const LongColumn& t = times.values;
    for (std::size_t h = 0; h < found.holes.size(); ++h) {
        const std::size_t row = found.holes[h].row;
        std::size_t from = row - std::min(row, reach), to = std::min(row + 1 + reach, t.size() - 1);
        if (h > 0) from = std::max(from, found.holes[h - 1].row + 1);
        if (h + 1 < found.holes.size()) to = std::min(to, found.holes[h + 1].row);
        const double rows = static_cast<double>(to - from) + static_cast<double>(found.holes[h].n_missing);
        const double steps = (t[to] - t[from]) / found.step;
        if (std::fabs(steps - rows) <= 0.6) continue;
        refuse(path, times,
               fmt::format("after row {} the times jump from {} to {} and then do not go on evenly, so that they "
                           "do not say how many rows are missing; --map time=none and --map rate_hz=... if none are",
                           row + 1, t[row], t[row + 1]));
    }
}

// Where daylight saving time begins no rows are missing.
void check_local_time(const TextColumn& times, const RowTimes& found, const std::string& path) {
    if (!times.is_local) return;
    for (const Hole& hole : found.holes) {
        const double jump = times.values[hole.row + 1] - times.values[hole.row];
        if (std::fabs(jump - 3600.0 - found.step) > 0.6 * found.step) continue;
        refuse(path, times,
               fmt::format("after row {} the local time jumps by an hour, as it does where daylight saving time "
                           "begins; allowed are dates with a time zone, or --map time=none with rate_hz if no rows are "
                           "missing there",
                           hole.row + 1));
    }
}

// A row that stands twice would shift all that follow by one. Stamps that are merely late or coarse make up for it
// beside.
void check_repetitions(const TextColumn& times, const std::string& path) {
    const LongColumn& t = times.values;
    std::size_t n_zero = 0;
    for (std::size_t k = 1; k < t.size(); ++k) n_zero += t[k] == t[k - 1] ? 1u : 0u;
    if (n_zero == 0 || 4 * n_zero > t.size()) return;
    const double mean = (t.back() - t.front()) / static_cast<double>(t.size() - 1);
    for (std::size_t k = 1; k < t.size(); ++k) {
        if (t[k] != t[k - 1]) continue;
        const std::size_t from = k > 1 ? k - 2 : 0, to = std::min(k + 1, t.size() - 1);
        if (t[to] - t[from] > (static_cast<double>(to - from) - 0.4) * mean) continue;
        refuse(path, times,
               fmt::format("row {} has the time {} of the row before it; allowed are times that rise, or --map "
                           "time=none with rate_hz if no row stands twice",
                           k + 1, t[k]));
    }
}

// The rows of a window that has no hole must be as far apart as those of the whole file; and a hole at every row is
// none.
void check_one_rate(const TextColumn& times, const RowTimes& found, const std::string& path) {
    constexpr std::size_t window = 32, most_holes = 8;
    const LongColumn& t = times.values;
    const auto refuse_step = [&](std::size_t row, double step) {
        refuse(path, times,
               fmt::format("its rows are {:.6g} apart from row {} on and {:.6g} elsewhere; allowed is one rate "
                           "throughout, or --map time=none with rate_hz",
                           step, row + 1, found.step));
    };
    std::size_t from = 0, n_running = 0, next = 0;
    for (std::size_t k = 0; k + 1 < t.size(); ++k) {
        const bool is_hole = next < found.holes.size() && found.holes[next].row == k;
        n_running = is_hole ? n_running + 1 : 0;
        if (n_running == most_holes) refuse_step(k + 1 - most_holes, t[k + 1] - t[k]);
        if (is_hole) {
            ++next;
            from = k + 1;
        }
        if (k + 1 - from < window) continue;
        const double step = (t[k + 1] - t[from]) / static_cast<double>(window);
        if (std::fabs(step - found.step) > 0.2 * found.step) refuse_step(from, step);
        ++from;
    }
    // Thirds by the numbers of their rows, missing ones with them, each as well as its ends are known and as chance
    // lets steps add up that scatter. A hundredth: no clock drifts by so much.
    constexpr double most_apart = 0.01;
    constexpr std::size_t n_pieces = 3;
    if (t.size() < n_pieces * window) return;
    double squares = 0.0;
    for (std::size_t k = 0; k + 1 < t.size(); ++k)
        if (const double off = t[k + 1] - t[k] - found.step; std::fabs(off) < 0.5 * found.step) squares += off * off;
    const double chance = 6.0 * std::sqrt(squares * n_pieces) / static_cast<double>(t.size());
    std::vector<double> steps;
    const auto begin_of = [&](std::size_t piece) { return piece * (t.size() - 1) / n_pieces; };
    for (std::size_t piece = 0; piece < n_pieces; ++piece) {
        const std::size_t begin = begin_of(piece), end = begin_of(piece + 1);
        double rows = static_cast<double>(end - begin);
        for (const Hole& hole : found.holes)
            if (hole.row >= begin && hole.row < end) rows += static_cast<double>(hole.n_missing);
        steps.push_back((t[end] - t[begin]) / rows);
    }
    const auto [least, most] = std::minmax_element(steps.begin(), steps.end());
    const double known = 6.0 * (found.tolerance - 1e-3);
    const auto odd = std::fabs(*least - found.step) > std::fabs(*most - found.step) ? least : most;
    if (*most - *least > (most_apart + known) * found.step + chance)
        refuse_step(begin_of(static_cast<std::size_t>(odd - steps.begin())), *odd);
}

// The place to which stamps are rounded, where that is no small part of a row; 0: it is. A decimal one, or the tick of
// a clock, as the smallest step has it within the last digit that is written.
struct Place {
    double size = 0.0;
    bool is_decimal = false;
    double digit = 0.0;
};

Place coarse_place(const LongColumn& t, double step) {
    double digit = std::pow(10.0, std::floor(std::log10(step) + 1e-9));
    // As far as a number near 1.7e9 s tells a millisecond.
    const auto is_place = [&](double v) {
        return std::fabs(v / digit - std::round(v / digit)) <
               1e-4 + std::fabs(v) * std::numeric_limits<double>::epsilon() / digit;
    };
    while (digit > 1e-3 * step && !std::ranges::all_of(t, is_place)) digit /= 10.0;
    if (digit > 0.2 * step) return {digit, true, 0.0};
    if (digit <= 1e-3 * step) digit = 0.0;
    const double first = t.front();
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 1; k < t.size(); ++k)
        if (t[k] > t[k - 1]) least = std::min(least, t[k] - t[k - 1]);
    double n_ticks = 0.0;
    for (std::size_t k = 1; k < t.size(); ++k)
        n_ticks += std::round((t[k] - t[k - 1]) / (n_ticks > 0.0 ? (t[k - 1] - first) / n_ticks : least));
    const double tick = digit == 0.0 ? least : (t.back() - first) / n_ticks;
    const double far = std::max(std::fabs(first), std::fabs(t.back()));
    const double rounding = 1e-3 + (digit + 4.0 * far * std::numeric_limits<double>::epsilon()) / tick;
    const bool are_multiples = rounding < 0.2 && std::ranges::all_of(t, [&](double v) {
                                   const double n = (v - first) / tick;
                                   return std::fabs(n - std::round(n)) < rounding;
                               });
    return {are_multiples && tick > 0.2 * step ? tick : 0.0, false, digit};
}

// Of the strip about an even course, with these holes, that holds all times; convex in the step.
double width_about(const LongColumn& t, double step, const std::vector<Hole>& holes) {
    const double first = t.front();
    double low = 0.0, high = 0.0, n_missing = 0.0;
    auto hole = holes.begin();
    for (std::size_t k = 0; k < t.size(); ++k) {
        const double late = t[k] - first - step * (static_cast<double>(k) + n_missing);
        low = std::min(low, late);
        high = std::max(high, late);
        if (hole != holes.end() && hole->row == k) n_missing += static_cast<double>((hole++)->n_missing);
    }
    return high - low;
}

struct EvenCourse {
    double step = 0.0;
    double width = 0.0;
};

// The one in the narrowest strip, of those as far from the mean step as a place at the ends allows.
EvenCourse narrowest(const LongColumn& t, double place, const std::vector<Hole>& holes, std::int64_t n_missing) {
    const double n_steps = static_cast<double>(t.size() - 1) + static_cast<double>(n_missing);
    double least = (t.back() - t.front() - place) / n_steps, most = (t.back() - t.front() + place) / n_steps;
    for (int pass = 0; pass < 40; ++pass) {
        const double lower = least + (most - least) / 3.0, upper = most - (most - least) / 3.0;
        if (width_about(t, lower, holes) < width_about(t, upper, holes))
            most = upper;
        else
            least = lower;
    }
    return {(least + most) / 2.0, width_about(t, (least + most) / 2.0, holes)};
}

// Rows from one step that is a place longer to the next, where such steps come at even times, as those of rows that are
// no whole number of places apart do, whatever else is missing between them; 0: they do not.
double regular_gap(const LongColumn& t, double step, double far, double place) {
    // What is tried and kept bounds time and memory. Of 600 files of 300 to 3000 rows, 1 to 9 % of them lost by chance,
    // 3 had such a comb, all with 9 % lost.
    constexpr std::size_t fewest = 6, most_tried = 64, most = std::size_t{1} << 16;
    const double reach = step + place / 2.0;
    std::vector<double> at;
    for (std::size_t k = 1; k < t.size() && at.size() < most; ++k)
        if (const double longer = t[k] - t[k - 1] - step; longer > far && longer < 1.5 * place) at.push_back(t[k]);
    for (std::size_t first = 0; first + 1 < std::min(at.size(), most_tried); ++first) {
        double period = at[first + 1] - at[first], n = 0.0, n_met = 0.0, n_missed = 0.0;
        if (period < 2.0 * reach) continue;
        for (std::size_t i = first + 1; i < at.size();) {
            n += 1.0;
            const double next = at[first] + n * period;
            while (i < at.size() && at[i] < next - reach) ++i;
            if (i == at.size()) break;
            if (at[i] <= next + reach) {
                if (i + 1 < at.size() && std::fabs(at[i + 1] - next) < std::fabs(at[i] - next)) ++i;
                n_met += 1.0;
                period = (at[i++] - at[first]) / n;
            } else {  // Between two such steps there is one miss, however long a hole is.
                n_missed += 1.0;
                n += std::max(0.0, std::floor((at[i] - reach - next) / period));
            }
        }
        if (n_met >= fewest && n_met >= 4.0 * n_missed) return (period - place) / step;
    }
    return 0.0;
}

// Whether a step that is taken for one row is so long that a row may be missing in it, of stamps within such a strip.
bool may_hide_rows(const LongColumn& t, const RowTimes& found, double width) {
    auto hole = found.holes.begin();
    for (std::size_t k = 1; k < t.size(); ++k)
        if (hole != found.holes.end() && hole->row == k - 1)
            ++hole;
        else if (t[k] - t[k - 1] > 2.0 * found.step - 1.01 * width)
            return true;
    return false;
}

// Rows that are lost by chance, a share p of them, are lost two and more in succession in a share p of the holes; where
// hardly any are, and enough should be to tell, the holes are those of another rate.
bool are_lost_by_chance(const RowTimes& found, std::size_t n_rows) {
    constexpr double enough = 8.0;
    const auto n_holes = static_cast<double>(found.holes.size()), missing = static_cast<double>(found.n_missing);
    const double expected = n_holes * missing / (missing + static_cast<double>(n_rows));
    const auto n = std::ranges::count_if(found.holes, [](const Hole& hole) { return hole.n_missing > 1; });
    return expected < enough || 4.0 * static_cast<double>(n) >= expected;
}

// Rounded stamps show rows that are missing only where all are within a place of an even course with these holes. Where
// rows are a whole number of places apart they always are, and a step that is longer is a hole or shows another rate:
// `said`, the step that is said, decides; 0: none is.
void check_coarse(const TextColumn& times, RowTimes& found, double said, const std::string& path) {
    const LongColumn& t = times.values;
    const double span = t.back() - t.front(), mean = span / static_cast<double>(t.size() - 1);
    const Place coarse = coarse_place(t, std::min(mean, found.step));
    if (coarse.size == 0.0) return;
    const double place = coarse.size, digit = coarse.digit, tolerance = 1e-3 + 2.0 * place / span;
    // The stamps at both ends are off by up to a place: over less than 20 places the rate is known to a tenth at best.
    const bool repeats = place > 1.01 * found.step;
    if (repeats && place > 0.05 * span && said == 0.0)
        refuse(path, times,
               fmt::format("its times, rounded to {:g}, span {:g}, which tells no rate; allowed is "
                           "--map rate_hz=... with time=none",
                           place, span));
    std::size_t n_odd = 0;
    const double far = 0.1 * place + digit;
    for (std::size_t k = 1; k < t.size(); ++k) n_odd += std::fabs((t[k] - t[k - 1]) - found.step) > far ? 1u : 0u;
    if (n_odd < 3) return;
    const bool are_few = 10 * n_odd < t.size();
    const auto is_even = [&](const EvenCourse& course) { return course.width <= 1.01 * place + digit; };
    const EvenCourse even = narrowest(t, place, {}, 0);
    const double whole = place * std::round(found.step / place);
    // A longer step in fewer than 50 rows, taken for a row, brings the mean step farther from a whole number of places.
    bool is_whole = !repeats && std::fabs(found.step - whole) <= 0.02 * place;
    if (is_whole && are_few) {
        // So many odd steps that came by chance lie as evenly as those of another rate once in 12^12/12!, 20 000.
        constexpr std::size_t fewest_even = 12;
        const double gap = regular_gap(t, found.step, far, place);
        if (gap == 0.0 && (n_odd < fewest_even || !is_even(even))) return;
        const double other = is_even(even) ? even.step : whole + place / gap;
        is_whole = std::fabs(found.step - whole) < std::fabs(found.step - other);
        if (is_whole && said > 0.0 && std::fabs(said - found.step) < std::fabs(said - other)) return;
        if (is_whole && said == 0.0)
            refuse(path, times,
                   fmt::format(
                       "its times, rounded to {:g}, are those of rows {:.6g} apart, and of rows {:.6g} apart of which "
                       "{} are missing; allowed is one of both: --map rate_hz=... with time_unit=...",
                       place, other, found.step, found.n_missing));
    }
    if (is_even(even)) {
        found = {.step = even.step, .tolerance = tolerance, .holes = {}, .n_missing = 0};
        return;
    }
    const EvenCourse course = narrowest(t, place, found.holes, found.n_missing);
    const bool is_said = said > 0.0 && std::fabs(said / found.step - 1.0) <= found.tolerance;
    // Of many rows that are missing a decimal place, to which any clock may round, says nothing.
    const bool are_lost =
        is_whole ? is_said || !(are_few || coarse.is_decimal || !are_lost_by_chance(found, t.size())) : !repeats;
    if (are_lost && is_even(course)) {
        found.step = course.step;
        found.tolerance = tolerance;
        return;
    }
    if (repeats ? !coarse.is_decimal : !may_hide_rows(t, found, std::max(course.width, place))) return;
    refuse(path, times,
           fmt::format("its times are rounded to {:g}, with rows about {:.6g} apart, and not even, so that they do not "
                       "say which rows are missing; --map time=none and --map rate_hz=... if none are{}",
                       place, found.step,
                       is_whole ? fmt::format(", rate_hz=... with time_unit=... if {} are", found.n_missing) : ""));
}

// Of the steps from row to row, holes left out, many are far from a row.
std::string odd_steps(const TextColumn& times, const RowTimes& found) {
    constexpr double far = 0.5, many = 0.01;
    const LongColumn& t = times.values;
    const double n_steps = static_cast<double>(t.size()) - 1.0;
    std::ptrdiff_t n = -std::ssize(found.holes);
    for (std::size_t k = 1; k < t.size(); ++k) n += std::fabs(t[k] - t[k - 1] - found.step) > far * found.step ? 1 : 0;
    if (static_cast<double>(n) <= many * n_steps) return {};
    return fmt::format("{}: {:.3g} % of its steps are more than half a row off {:.6g}; the rows are taken as even",
                       described(times), 100.0 * static_cast<double>(n) / n_steps, found.step);
}

}  // namespace

std::string missing_in_words(const TextColumn& times, const RowTimes& found) {
    return fmt::format("{}: {} rows are missing in {} place{}, the first after row {}", described(times),
                       found.n_missing, found.holes.size(), found.holes.size() == 1 ? "" : "s",
                       found.holes.front().row + 1);
}

RowClock row_clock(const TextTable& read, const std::string& path, const Mapping& mapping,
                   std::optional<double> presumed_step_s) {
    RowClock clock;
    const auto rate_hz = mapping.real("rate_hz");
    if (rate_hz) presumed_step_s = 1.0 / *rate_hz;
    if (!read.times) {
        if (!presumed_step_s) throw MappingError(fmt::format("{}: --map rate_hz=... is missing: rows a second", path));
        clock.step_s = *presumed_step_s;
        return clock;
    }
    const TextColumn& times = *read.times;
    clock.times = row_times(times, path, true, "--map time=none");
    if (!clock.times) {
        if (!presumed_step_s) refuse(path, times, "too few rows for a rate; allowed are 3 or more");
        clock.step_s = *presumed_step_s;
        return clock;
    }
    check_repetitions(times, path);
    const auto unit = known_time_unit(path, times.name, times.holds_dates, mapping);
    if (const auto named = unit_of(times.name); unit && named && !times.holds_dates && *named != *unit)
        clock.notes.push_back(
            fmt::format("{} is read in {} as said, against its name", described(times), mapping.text("time_unit")));
    const double said = presumed_step_s.value_or(0.0) * unit.value_or(0.0);
    refuse_clock_digits(times, *clock.times, path);
    check_coarse(times, *clock.times, said, path);
    check_holes(times, *clock.times, path);
    refuse_many_missing(path, described(times), times.values, *clock.times,
                        "; --map time=none with rate_hz if none are missing");
    check_local_time(times, *clock.times, path);
    check_one_rate(times, *clock.times, path);
    const double step = clock.times->step;
    if (unit) {
        const double by_times_s = step / *unit;
        if (presumed_step_s && std::fabs(by_times_s / *presumed_step_s - 1.0) > clock.times->tolerance)
            throw MappingError(
                fmt::format("{}, {}: a row is {:.6g} s by its times, {:.6g} s by what is said; allowed is one "
                            "value (time_unit=s, ms, us, ns, or time=none)",
                            path, described(times), by_times_s, *presumed_step_s));
        // By a tenth of a row over all of them at most.
        const double n_rows = static_cast<double>(times.values.size()) + static_cast<double>(clock.times->n_missing);
        const double allowed = std::min(clock.times->tolerance - 1e-3, 0.1 / n_rows) + 1e-9;
        clock.step_s = presumed_step_s.value_or(simplest(by_times_s, allowed));
    } else if (presumed_step_s) {
        const std::string why = contradiction(times, *clock.times, 1.0 / *presumed_step_s);
        if (!why.empty())
            throw MappingError(
                fmt::format("{}, {}, and a row is {:.6g} s by what is said; allowed is one value (time_unit=s, "
                            "ms, us, ns, or time=none)",
                            path, why, *presumed_step_s));
        if (const std::string name = presumed_unit(times, *clock.times, 1.0 / *presumed_step_s); !name.empty())
            clock.notes.push_back(fmt::format("{} is read as {}, which its name does not say", described(times), name));
        clock.step_s = *presumed_step_s;
    } else {
        throw MappingError(
            fmt::format("{}: --map time_unit=s, ms, us or ns is missing, of {}", path, described(times)));
    }
    if (const std::string odd = odd_steps(times, *clock.times); !odd.empty()) clock.warnings.push_back(odd);
    if (std::adjacent_find(times.values.begin(), times.values.end()) != times.values.end())
        clock.notes.push_back(
            fmt::format("{}: its times repeat, so that a single row that is missing is not seen", described(times)));
    if (!numbers_rows(times, *clock.times))
        clock.notes.push_back(fmt::format("{}: a row is {:.9g} s", described(times), clock.step_s));
    if (clock.times->n_missing > 0) clock.notes.push_back(missing_in_words(times, *clock.times));
    return clock;
}

}  // namespace zlg::logs
