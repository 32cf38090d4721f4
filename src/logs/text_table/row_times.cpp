#include <zlg/logs/row_times.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <zlg/logs/budget.hpp>
#include <zlg/logs/error.hpp>

#include "time_names.hpp"

namespace zlg::logs {

namespace {

std::vector<double> steps_of(std::span<const double> values) {
    std::vector<double> steps;
    for (std::size_t k = 1; k < values.size(); ++k) steps.push_back(values[k] - values[k - 1]);
    return steps;
}

double median_of(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

// The share of steps that are the usual one, as far as the values resolve it.
double even_share(std::span<const double> values, const std::vector<double>& steps, double usual) {
    const double size = std::max(std::fabs(values.front()), std::fabs(values.back()));
    const double rounding = 8.0 * size * std::numeric_limits<double>::epsilon();
    const auto n =
        std::ranges::count_if(steps, [&](double step) { return std::fabs(step - usual) <= 0.01 * usual + rounding; });
    return static_cast<double>(n) / static_cast<double>(steps.size());
}

constexpr std::size_t many_rows = 16;
constexpr std::int64_t most_missing = 1'000'000'000'000'000;

bool rises_evenly(std::span<const double> values) {
    if (values.size() < 3 || !std::ranges::all_of(values, [](double v) { return std::isfinite(v); })) return false;
    const std::vector<double> steps = steps_of(values);
    const double usual = median_of(steps);
    return usual > 0.0 && even_share(values, steps, usual) >= (values.size() < many_rows ? 1.0 : 0.9);
}

// A late stamp is followed by a short step; a hole is not.
bool is_hole(const std::vector<double>& steps, std::size_t k, double usual, double coarse) {
    if (!(steps[k] > 1.5 * usual + coarse)) return false;
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

bool rises_as_time(std::span<const double> values) {
    if (rises_evenly(values)) return true;
    return values.size() >= many_rows &&
           std::ranges::adjacent_find(values, [](double a, double b) { return !(b > a); }) == values.end();
}

std::optional<RowTimes> row_times(const TextColumn& column, const std::string& path, bool is_said,
                                  const std::string& none) {
    const bool by_name = is_said || names_time(column.name);
    const std::vector<double>& values = column.values;
    if (values.size() < 3) return std::nullopt;
    if (!by_name && !rises_evenly(values)) return std::nullopt;
    const std::vector<double> steps = steps_of(values);
    for (std::size_t k = 0; k < steps.size(); ++k) {
        if (steps[k] >= 0.0) continue;
        if (!is_said) return std::nullopt;  // t_min may be a temperature
        throw FormatError(
            fmt::format("{}, {}: after {} comes {} in row {}, and times do not go back; {} if it holds none", path,
                        described(column), values[k], values[k + 1], k + 2, none));
    }
    if (!std::ranges::all_of(steps, [](double step) { return std::isfinite(step); })) {
        if (!is_said) return std::nullopt;
        throw FormatError(fmt::format("{}, {}: a time is missing", path, described(column)));
    }
    // Stamps that repeat are coarser than the rows are close.
    const bool repeats = std::ranges::find(steps, 0.0) != steps.end();
    double coarse = 0.0;
    for (const double step : steps)
        if (repeats && step > 0.0) coarse = coarse > 0.0 ? std::min(coarse, step) : step;
    RowTimes times;
    const double span = values.back() - values.front();
    const double usual = repeats ? span / static_cast<double>(steps.size()) : median_of(steps);
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

void refuse_many_missing(const std::string& path, const std::string& column, std::span<const double> values,
                         const RowTimes& times, const std::string& if_none) {
    if (times.n_missing <= max_missing_rows(values.size())) return;
    const std::size_t row = std::ranges::max_element(times.holes, {}, &Hole::n_missing)->row;
    throw FormatError(
        fmt::format("{}, {}: {} rows are missing, most of them after row {}, where it jumps from {} to {}; allowed are "
                    "{} beside the "
                    "{} that are there{}",
                    path, column, times.n_missing, row + 1, values[row], values[row + 1],
                    max_missing_rows(values.size()), values.size(), if_none));
}

void fill_holes(std::vector<double>& values, const RowTimes& times) {
    if (times.holes.empty()) return;
    std::vector<double> filled;
    filled.reserve(values.size() + static_cast<std::size_t>(times.n_missing));
    std::size_t next = 0;
    for (std::size_t row = 0; row < values.size(); ++row) {
        filled.push_back(values[row]);
        if (next == times.holes.size() || times.holes[next].row != row) continue;
        filled.insert(filled.end(), static_cast<std::size_t>(times.holes[next++].n_missing),
                      std::numeric_limits<double>::quiet_NaN());
    }
    values = std::move(filled);
}

}  // namespace zlg::logs
