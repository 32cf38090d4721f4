#include "suspect_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <utility>
#include <vector>
#include <zlg/logs/error.hpp>

#include "text_table/steps.hpp"

namespace zlg::logs {

namespace {

double size_of_step(double step) { return std::fabs(step); }

// From one known value to the next.
struct Step {
    std::size_t from = 0, to = 0;
    double size = 0.0;

    [[nodiscard]] double rows() const { return static_cast<double>(to - from); }
};

template <class Use> void each_step(const LongColumn& values, Use use) {
    std::size_t last = 0;
    for (std::size_t k = 1; k < values.size(); ++k) {
        if (std::isnan(values[k])) continue;
        if (!std::isnan(values[last])) use(Step{last, k, values[k] - values[last]});
        last = k;
    }
}

// A saw, whatever its height: nearly all steps go one way, +1 or -1. 0: they do not, as in what swings to and fro.
double way_of(const LongColumn& values) {
    constexpr std::size_t enough = 12;
    std::size_t up = 0, down = 0;
    each_step(values, [&](const Step& step) {
        up += step.size > 0.0 ? 1u : 0u;
        down += step.size < 0.0 ? 1u : 0u;
    });
    if (up + down < enough || 4 * std::min(up, down) > up + down) return 0.0;
    return up > down ? 1.0 : -1.0;
}

}  // namespace

// A jump of a whole range is a register or a circle that began anew: of a range that is known, where the steps beside
// it are small; of the whole height of a saw against its way.
void refuse_wraps(const ForeignLook& look, const TextColumn& column, const AngleUnit& unit) {
    const bool is_angle = look.mapping.text("holds") == "angle";
    // A rate or an increment is a register where all of it are whole numbers.
    const auto is_whole = [](double v) { return std::isnan(v) || v == std::floor(v); };
    if (!is_angle && !std::ranges::all_of(column.values, is_whole)) return;
    if (std::ranges::count_if(column.values, [](double v) { return !std::isnan(v); }) < 4) return;
    const double usual = usual_step(column.values, 0.5, size_of_step), way = is_angle ? way_of(column.values) : 0.0;
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const double value : column.values) {
        least = std::fmin(least, value);
        most = std::fmax(most, value);
    }
    constexpr double circle = 360.0 * 3600.0;
    const std::vector<double> ranges = unit.of_counts || !is_angle
                                           ? std::vector<double>{65536.0, 16777216.0, 4294967296.0}
                                           : std::vector<double>{circle / unit.arcsec, circle / 2.0 / unit.arcsec};
    each_step(column.values, [&](const Step& step) {
        const double jump = std::fabs(step.size), slack = 5.0 * usual * step.rows();
        const auto is_range = [&](double range) {
            return slack < range / 8.0 && std::fabs(jump - range) <= slack + 1e-3 * range;
        };
        const bool ends_a_saw = step.size * way < 0.0 && jump > std::max((most - least) / 2.0, most - least - slack);
        const auto range = std::ranges::find_if(ranges, is_range);
        if (ends_a_saw || range != ranges.end())
            throw FormatError(
                fmt::format("{}, {}, row {}: it jumps from {} to {}, as one that begins anew after {:.9g} does; "
                            "allowed are numbers that go on",
                            look.table.path, described(column), step.to + 1, column.values[step.from],
                            column.values[step.to], range == ranges.end() ? jump + usual : *range));
    });
}

void take_out_missing(const Mapping& mapping, TextTable& read) {
    const auto mark = mapping.real("missing");
    if (!mark) return;
    for (TextColumn& column : read.columns)
        column.values.change([&](double v) { return v == *mark ? std::numeric_limits<double>::quiet_NaN() : v; });
}

void refuse_missing_marks(const std::string& path, const TextColumn& column) {
    constexpr std::array<double, 9> marks{999.0,   9999.0,  99999.0,      999999.0,    9999999.0,
                                          32767.0, 32768.0, 2147483647.0, 2147483648.0};
    std::map<std::pair<bool, std::size_t>, std::size_t> first;  // of sign and mark the row, from 0
    for (std::size_t k = 0; k < column.values.size(); ++k) {
        const double size = std::fabs(column.values[k]);
        if (!(size >= marks.front())) continue;
        const auto m = static_cast<std::size_t>(std::ranges::find(marks, size) - marks.begin());
        if (m < marks.size()) first.try_emplace({column.values[k] > 0.0, m}, k);
    }
    for (const auto& [found, row] : first) {
        const double mark = found.first ? marks[found.second] : -marks[found.second];
        double least = std::numeric_limits<double>::infinity(), most = -least;
        for (const double value : column.values) {
            if (std::isnan(value) || value == mark) continue;
            least = std::min(least, value);
            most = std::max(most, value);
        }
        const double apart = std::max(least - mark, mark - most);
        if (!(most > least) || !(apart > 10.0 * (most - least))) continue;
        throw FormatError(
            fmt::format("{}, {}, row {}: {} is far from all other values, as a mark of a missing one is; allowed "
                        "is nan there, or --map missing={}",
                        path, described(column), row + 1, mark, mark));
    }
}

namespace {

// Rows of one value, one after the other.
struct Stretch {
    std::size_t from = 0, n = 0;
};

// What the steps from row to row say.
struct Steps {
    std::size_t n = 0, n_same = 0;
    std::vector<Stretch> stretches;  // of many rows; they are not among n and n_same
    double usual = 0.0;              // median of those that are none of 0
    double least = 0.0;              // of them
    bool are_whole = true;           // the values

    [[nodiscard]] double share() const { return n == 0 ? 0.0 : static_cast<double>(n_same) / static_cast<double>(n); }
};

double size_but_0(double step) { return step == 0.0 ? std::numeric_limits<double>::quiet_NaN() : std::fabs(step); }

Steps look_at_steps(const LongColumn& values) {
    constexpr std::size_t many_rows = 32;
    Steps steps;
    double least = std::numeric_limits<double>::infinity();
    Stretch run;
    const auto end_run = [&] {
        if (run.n < many_rows) {
            steps.n_same += run.n > 0 ? run.n - 1 : 0;
            steps.n += run.n;
        } else {
            steps.stretches.push_back(run);
        }
    };
    for (std::size_t k = 0; k < values.size(); ++k) {
        if (!std::isnan(values[k])) steps.are_whole = steps.are_whole && values[k] == std::floor(values[k]);
        if (k > 0 && values[k] == values[k - 1]) {
            ++run.n;
            continue;
        }
        if (k > 0) least = std::fmin(least, size_but_0(values[k] - values[k - 1]));
        end_run();
        run = {k, std::isnan(values[k]) ? 0u : 1u};
    }
    end_run();
    if (std::isinf(least)) return steps;
    steps.least = least;
    steps.usual = usual_step(values, 0.5, size_but_0);
    return steps;
}

std::string percent(double share) { return fmt::format("{:.3g} %", 100.0 * share); }

// A sensor slower than its log repeats values that noise would part. Of white noise rounded to `least` a share of
// least/(2 sqrt(pi) sigma) repeats by chance, and the median of the other steps is .954 sigma.
std::string repeats(const TextColumn& column, const Steps& steps) {
    constexpr double fewest = 0.05, noise = 8.0, by_chance = 0.27, often = 3.0;
    const double share = steps.share();
    if (share < fewest || steps.usual < noise * steps.least) return {};
    if (share < often * by_chance * steps.least / steps.usual) return {};
    return fmt::format("{}: {} of its rows repeat the row before; each value stands {:.2g} times", described(column),
                       percent(share), 1.0 / (1.0 - share));
}

// Samples that were lost and written as 0, here and there: far more rows than at the values beside 0 on its own grid.
// Where nothing lies within half a usual step of 0, that step is the grid.
std::string zeros(const TextColumn& column, const Steps& steps) {
    constexpr double fewest = 0.002, noise = 8.0, often = 4.0, beside = 4.0;
    if (steps.are_whole || steps.usual < noise * steps.least) return {};
    double n_zero = 0.0, n_near = 0.0, n_beside = 0.0;
    for (const double value : column.values) {
        n_zero += value == 0.0;
        n_near += value != 0.0 && std::fabs(value) <= steps.usual / 2.0;
        n_beside += value != 0.0 && std::fabs(value) <= beside * steps.least;
    }
    for (const Stretch& stretch : steps.stretches)
        if (column.values[stretch.from] == 0.0) n_zero -= static_cast<double>(stretch.n);
    const double share = n_zero / static_cast<double>(column.values.size());
    if (share < fewest || n_near == 0.0 || n_zero <= often * n_beside) return {};
    return fmt::format("{}: {} of its rows are exactly 0, as lost ones are", described(column), percent(share));
}

// The outermost values with their numbers of rows, from outside on.
class Outermost {
public:
    explicit Outermost(bool (*is_outside)(double, double)) : values_{is_outside} {}
    void note(double value) {
        if (values_.size() == kept && values_.key_comp()(values_.rbegin()->first, value)) return;
        ++values_[value];
        if (values_.size() > kept) values_.erase(std::prev(values_.end()));
    }
    // A column ends at a rail where its outermost value stands far more often than those beside it.
    [[nodiscard]] bool is_rail() const {
        constexpr std::size_t fewest = 10;
        if (values_.size() < kept || value() == 0.0 || n() < fewest) return false;
        return std::all_of(std::next(values_.begin()), values_.end(), [this](const auto& beside) {
            constexpr std::size_t more = 5;
            return n() > more * beside.second;
        });
    }
    [[nodiscard]] double value() const { return values_.begin()->first; }
    [[nodiscard]] std::size_t n() const { return values_.begin()->second; }

private:
    static constexpr std::size_t kept = 5;
    std::map<double, std::size_t, bool (*)(double, double)> values_;
};

struct Rails {
    explicit Rails(const LongColumn& values) {
        for (const double value : values) {
            if (std::isnan(value)) continue;
            largest.note(value);
            smallest.note(value);
        }
    }
    [[nodiscard]] bool are_at(double value) const {
        return (largest.is_rail() && value == largest.value()) || (smallest.is_rail() && value == smallest.value());
    }

    Outermost largest{[](double a, double b) { return a > b; }}, smallest{[](double a, double b) { return a < b; }};
};

std::string rails_in_words(const TextColumn& column, const Steps& steps, const Rails& rails) {
    constexpr double widest_noise = 32.0;  // of a counter at rest, in its steps
    std::string text;
    for (const auto& [outermost, name] :
         {std::pair{&rails.largest, "largest"}, std::pair{&rails.smallest, "smallest"}}) {
        if (!outermost->is_rail() || rails.largest.value() - rails.smallest.value() < widest_noise * steps.least)
            continue;
        text += fmt::format("{}{} of its rows are at {}, its {} value", text.empty() ? "" : ", and ",
                            percent(static_cast<double>(outermost->n()) / static_cast<double>(column.values.size())),
                            outermost->value(), name);
    }
    return text.empty() ? text : fmt::format("{}: {}, as where a range ends", described(column), text);
}

// Longer by far than chance makes them where such a share of the other rows repeats. A counter at rest counts nothing.
std::string stretches(const TextColumn& column, const Steps& steps, const Rails& rails, const std::string& holds) {
    constexpr double far = 10.0;
    if (steps.are_whole && holds == "angle") return {};
    const double share = steps.share();
    const double n = static_cast<double>(column.values.size());
    const double longest = far * (share > 0.0 ? std::max(1.0, std::log(n) / -std::log(share)) : 1.0);
    std::size_t n_stretches = 0, n_rows = 0;
    Stretch first;
    for (const Stretch& stretch : steps.stretches) {
        const double value = column.values[stretch.from];
        if ((steps.are_whole && value == 0.0) || rails.are_at(value) || static_cast<double>(stretch.n) < longest ||
            stretch.n == column.values.size())
            continue;
        if (n_stretches++ == 0) first = stretch;
        n_rows += stretch.n;
    }
    if (n_stretches == 0) return {};
    const bool at_end = first.from + first.n == column.values.size();
    const std::string rows = at_end ? fmt::format("its last {} rows", first.n)
                                    : fmt::format("rows {} to {}", first.from + 1, first.from + first.n);
    return fmt::format(
        "{}: {} are all {}, and count as any other{}", described(column), rows, column.values[first.from],
        n_stretches == 1 ? std::string{} : fmt::format("; {} such stretches hold {} rows", n_stretches, n_rows));
}

template <class Values> std::string spikes_of(const Values& values, const std::string& what) {
    constexpr double far = 100.0;
    constexpr std::size_t longest = 8, longest_of_one_value = 32;
    const double least = far * usual_step(values, 0.5, size_but_0);
    // The first row that is back from a jump to row k.
    const auto back = [&](std::size_t k) {
        const double jump = std::fabs(values[k] - values[k - 1]);
        bool is_one = true;
        for (std::size_t to = k + 1; to < std::min(values.size(), k + longest_of_one_value); ++to) {
            if (std::fabs(values[to] - values[k - 1]) < 0.1 * jump) return to;
            is_one = is_one && values[to] == values[k];
            if (!is_one && to >= k + longest) break;
        }
        return k;
    };
    const auto jumps = [&](std::size_t k) { return std::fabs(values[k] - values[k - 1]) > least; };
    std::size_t n = 0, first = 0;
    for (std::size_t k = 1; k < values.size(); ++k) {
        if (!jumps(k)) continue;
        const std::size_t to = back(k);
        if (n == 0) first = k;
        n += to - k;
        k = std::max(k, to);
    }
    // A number above the table, such as its rate, is taken for the first row.
    if (n == 0 && values.size() > 2 && jumps(1) && !jumps(2))
        return fmt::format("{}: the first row, {}, is more than {:g} usual steps from the next ones", what, values[0],
                           far);
    if (n == 0) return {};
    return fmt::format("{}: {} row{} jump{} away by more than {:g} usual steps and back, the first is row {}, {}", what,
                       n, n == 1 ? "" : "s", n == 1 ? "s" : "", far, first + 1, values[first]);
}

}  // namespace

std::string spikes(std::span<const double> values, const std::string& what) { return spikes_of(values, what); }

std::vector<std::string> no_measurements(const TextColumn& column, const std::string& holds) {
    const Steps steps = look_at_steps(column.values);
    const Rails rails{column.values};
    std::vector<std::string> lines;
    for (std::string line : {spikes_of(column.values, described(column)), repeats(column, steps), zeros(column, steps),
                             stretches(column, steps, rails, holds),
                             holds == "angle" ? std::string{} : rails_in_words(column, steps, rails)})
        if (!line.empty()) lines.push_back(std::move(line));
    return lines;
}

}  // namespace zlg::logs
