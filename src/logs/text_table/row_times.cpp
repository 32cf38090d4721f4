#include <zlg/logs/row_times.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <zlg/logs/budget.hpp>
#include <zlg/logs/error.hpp>

#include "steps.hpp"
#include "time_names.hpp"

namespace zlg::logs {

namespace {

// From row to row.
struct Differences {
    const LongColumn& values;

    [[nodiscard]] std::size_t size() const { return values.size() - 1; }
    [[nodiscard]] double operator[](std::size_t k) const { return values[k + 1] - values[k]; }
};

// The share of steps that are the usual one, as far as the values resolve it.
double even_share(const Differences& steps, double usual) {
    const double size = std::max(std::fabs(steps.values.front()), std::fabs(steps.values.back()));
    const double rounding = 8.0 * size * std::numeric_limits<double>::epsilon();
    std::size_t n = 0;
    for (std::size_t k = 0; k < steps.size(); ++k)
        n += std::fabs(steps[k] - usual) <= 0.01 * usual + rounding ? 1u : 0u;
    return static_cast<double>(n) / static_cast<double>(steps.size());
}

constexpr std::size_t many_rows = 16;
constexpr std::int64_t most_missing = 1'000'000'000'000'000;

bool rises_evenly(const LongColumn& values) {
    if (values.size() < 3 || !std::ranges::all_of(values, [](double v) { return std::isfinite(v); })) return false;
    const double usual = usual_step(values);
    return usual > 0.0 && even_share({values}, usual) >= (values.size() < many_rows ? 1.0 : 0.9);
}

// Of the steps that are the usual one but for half of it: of stamps of 0, 2, 5, 7 ms the median is none.
double mean_of_usual(const Differences& steps, double usual) {
    double sum = 0.0, n = 0.0;
    for (std::size_t k = 0; k < steps.size(); ++k)
        if (const double step = steps[k]; std::fabs(step - usual) <= 0.501 * usual) n += 1.0, sum += step;
    return n > 0.0 ? sum / n : usual;
}

// A late stamp is followed by a short step; a hole is not. A step of just one and a half is none of both.
bool is_hole(const Differences& steps, std::size_t k, double usual, double coarse) {
    if (!(steps[k] > 1.501 * usual + coarse)) return false;
    const double least = 2.5 * usual + coarse;
    const bool alone_before = k == 0 || steps[k] + steps[k - 1] > least;
    const bool alone_after = k + 1 == steps.size() || steps[k] + steps[k + 1] > least;
    return alone_before && alone_after;
}

std::optional<double> said_unit(const TextColumn& column) {
    return column.holds_dates ? std::optional{1.0} : unit_of(column.name);
}

bool fits(const RowTimes& times, double to_a_second, double rate_hz) {
    return std::fabs(to_a_second / times.step / rate_hz - 1.0) <= times.tolerance;
}

struct Unit {
    const char* name;
    double to_a_second;
};

// Of the units that stamps without a name for it may have: the one that agrees with the rate.
const Unit* unnamed_unit(const RowTimes& times, double rate_hz) {
    static constexpr std::array<Unit, 4> usual{
        {{"seconds", 1.0}, {"milliseconds", 1e3}, {"microseconds", 1e6}, {"nanoseconds", 1e9}}};
    const auto found = std::ranges::find_if(usual, [&](const Unit& u) { return fits(times, u.to_a_second, rate_hz); });
    return found == usual.end() ? nullptr : &*found;
}

}  // namespace

bool rises_as_time(const LongColumn& values) {
    if (rises_evenly(values)) return true;
    return values.size() >= many_rows && std::adjacent_find(values.begin(), values.end(), [](double a, double b) {
                                             return !(b > a);
                                         }) == values.end();
}

std::optional<RowTimes> row_times(const TextColumn& column, const std::string& path, bool is_said,
                                  const std::string& none) {
    const bool by_name = is_said || names_time(column.name);
    const LongColumn& values = column.values;
    if (values.size() < 3) return std::nullopt;
    if (!by_name && !rises_evenly(values)) return std::nullopt;
    const Differences steps{values};
    bool repeats = false;
    double coarse = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < steps.size(); ++k) {
        if (steps[k] > 0.0) coarse = std::min(coarse, steps[k]);
        repeats = repeats || steps[k] == 0.0;
        if (steps[k] >= 0.0 && std::isfinite(steps[k])) continue;
        if (!is_said) return std::nullopt;  // t_min may be a temperature
        if (!std::isfinite(steps[k]))
            throw FormatError(fmt::format("{}, {}: a time is missing", path, described(column)));
        throw FormatError(
            fmt::format("{}, {}: after {} comes {} in row {}, and times do not go back; {} if it holds none", path,
                        described(column), values[k], values[k + 1], k + 2, none));
    }
    // Stamps that repeat are coarser than the rows are close.
    if (!repeats || std::isinf(coarse)) coarse = 0.0;
    RowTimes times;
    const double span = values.back() - values.front();
    const double usual = repeats ? span / static_cast<double>(steps.size()) : mean_of_usual(steps, usual_step(values));
    double counted = 0.0;
    double scatter = 0.0;
    std::size_t n_counted = 0;
    for (std::size_t k = 0; k < steps.size(); ++k) {
        if (is_hole(steps, k, usual, coarse)) {
            times.holes.push_back({k, 0});
            continue;
        }
        counted += steps[k];
        ++n_counted;
        scatter = std::max(scatter, std::fabs(steps[k] - usual));
    }
    if (!(counted > 0.0)) return std::nullopt;
    times.step = counted / static_cast<double>(n_counted);
    times.tolerance = 1e-3 + 2.0 * (scatter + coarse) / counted;
    // By the mean step: stamps of 0, 2, 5, 7 ms have none that is the usual one.
    for (Hole& hole : times.holes) {
        const double n = std::min(std::round(steps[hole.row] / times.step) - 1.0, static_cast<double>(most_missing));
        hole.n_missing = std::max<std::int64_t>(static_cast<std::int64_t>(n), 1);
        times.n_missing = std::min(times.n_missing + hole.n_missing, most_missing);
    }
    // Over the holes too, where these are as many rows by that step: its scatter is that of the two ends then, and not
    // of each stretch between two holes, and late stamps that were taken for holes do not bend it.
    const double whole = span / (static_cast<double>(steps.size()) + static_cast<double>(times.n_missing));
    const auto is_as_many = [&](const Hole& hole) {
        return std::round(steps[hole.row] / whole) - 1.0 == static_cast<double>(hole.n_missing);
    };
    if (std::fabs(whole - times.step) <= 0.02 * times.step && std::ranges::all_of(times.holes, is_as_many))
        times.step = whole;
    return times;
}

bool numbers_rows(const TextColumn& column, const RowTimes& times) {
    return !said_unit(column) && (times.step == 1.0 || names_counter(column.name)) &&
           std::ranges::all_of(column.values, [](double v) { return v == std::floor(v); });
}

std::string contradiction(const TextColumn& column, const RowTimes& times, double rate_hz) {
    if (numbers_rows(column, times)) return {};
    const std::optional<double> named = said_unit(column);
    if (named ? fits(times, *named, rate_hz) : unnamed_unit(times, rate_hz) != nullptr) return {};
    return rate_in_words(column, times);
}

std::string presumed_unit(const TextColumn& column, const RowTimes& times, double rate_hz) {
    if (said_unit(column) || numbers_rows(column, times)) return {};
    const Unit* unit = unnamed_unit(times, rate_hz);
    return unit == nullptr || unit->to_a_second == 1.0 ? std::string{} : std::string{unit->name};
}

std::string rate_in_words(const TextColumn& column, const RowTimes& times) {
    const std::optional<double> named = said_unit(column);
    return fmt::format("{} rises by {:.6g} a row, which is {:.6g} Hz{}", described(column), times.step,
                       named.value_or(1.0) / times.step, named ? "" : " in seconds");
}

void refuse_many_missing(const std::string& path, const std::string& column, const LongColumn& values,
                         const RowTimes& times, const std::string& if_none) {
    if (times.n_missing <= max_missing_rows(values.size())) return;
    const std::size_t row = std::ranges::max_element(times.holes, {}, &Hole::n_missing)->row;
    throw FormatError(
        fmt::format("{}, {}: {} rows are missing, most of them after row {}, where it jumps from {} to {}; allowed are "
                    "{} beside the {} that are there{}",
                    path, column, times.n_missing, row + 1, values[row], values[row + 1],
                    max_missing_rows(values.size()), values.size(), if_none));
}

void fill_holes(LongColumn& values, const RowTimes& times) {
    if (times.holes.empty()) return;
    auto hole = times.holes.begin();
    LongColumn filled;
    for (std::size_t k = 0; k < values.size(); ++k) {
        filled.push_back(values[k]);
        if (hole == times.holes.end() || hole->row != k) continue;
        for (std::int64_t n = 0; n < hole->n_missing; ++n) filled.push_back(std::numeric_limits<double>::quiet_NaN());
        ++hole;
    }
    values = std::move(filled);
}

}  // namespace zlg::logs
