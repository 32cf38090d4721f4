#include <zlg/sweep/tolerances.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "draw_names.hpp"

namespace zlg::sweep {
namespace {

constexpr double draw_in = 0.9;

// A gyro as the ways of its parameters, and whether it passes.
struct Placed {
    std::int64_t gyro = 0;
    std::vector<double> ways;
    bool passes = false;
};

std::vector<Placed> placed(const Gyros& gyros, const Rows& rows, const std::vector<Range>& ranges) {
    std::vector<Placed> all;
    for (const auto& [gyro, row] : rows) {
        const std::vector<Value> values = gyros.values(gyro);
        Placed one{.gyro = gyro, .ways = {}, .passes = passes_all(gyros.description(), row)};
        for (const Range& range : ranges) one.ways.push_back(range.way(std::get<double>(values[range.parameter])));
        all.push_back(std::move(one));
    }
    return all;
}

struct Count {
    std::int64_t passed = 0;
    std::int64_t gyros = 0;

    [[nodiscard]] double yield() const { return static_cast<double>(passed) / static_cast<double>(gyros); }
};

bool is_within(const Placed& one, const std::vector<double>& ways) {
    return std::ranges::equal(one.ways, ways, std::ranges::less_equal{});
}

Count count_within(const std::vector<Placed>& all, const std::vector<double>& ways) {
    Count count;
    for (const Placed& one : all) {
        if (!is_within(one, ways)) continue;
        ++count.gyros;
        if (one.passes) ++count.passed;
    }
    return count;
}

Yield yield_within(const std::vector<Placed>& all, const std::vector<double>& ways, const Description& description) {
    YieldCount count{description};
    for (const Placed& one : all) {
        if (!is_within(one, ways)) continue;
        count.add(one.gyro);
        if (one.passes) count.pass(one.gyro);
    }
    return count.yield();
}

// The parameter to draw in next; ways.size(): none leaves enough gyros.
std::size_t next(const std::vector<Placed>& all, const std::vector<double>& ways, std::int64_t least_gyros) {
    const Count before = count_within(all, ways);
    std::size_t best = ways.size();
    double best_gain = 0.0;
    for (std::size_t k = 0; k < ways.size(); ++k) {
        std::vector<double> tried = ways;
        tried[k] *= draw_in;
        const Count after = count_within(all, tried);
        if (after.gyros < least_gyros) continue;
        const auto lost = static_cast<double>(before.gyros - after.gyros);
        const double gain = (after.yield() - before.yield()) / (lost + 1.0);
        if (best < ways.size() && gain <= best_gain) continue;
        best = k;
        best_gain = gain;
    }
    return best;
}

void widen(Range& range, double value) {
    range.min = std::min(range.min, value);
    range.max = std::max(range.max, value);
}

// From the middle of a normal law, which has no ends, to the values of the rows.
void widen_to_rows(std::vector<Range>& ranges, const Gyros& gyros, const Rows& rows) {
    const std::vector<Parameter>& parameters = gyros.description().parameters;
    std::vector<Range*> without_ends;
    for (Range& range : ranges)
        if (!has_range(parameters[range.parameter].draw)) without_ends.push_back(&range);
    if (without_ends.empty()) return;
    for (const auto& [gyro, row] : rows) {
        const std::vector<Value> values = gyros.values(gyro);
        for (Range* range : without_ends) widen(*range, std::get<double>(values[range->parameter]));
    }
}

// The value that a key has in the base, where that is a number.
std::optional<double> number_in(const config::Settings& base, const std::string& key) {
    const auto at = std::ranges::find(base, key, &std::pair<std::string, std::string>::first);
    if (at == base.end()) return std::nullopt;
    char* end = nullptr;
    const double value = std::strtod(at->second.c_str(), &end);
    return end != at->second.c_str() && *end == '\0' ? std::optional{value} : std::nullopt;
}

}  // namespace

double Range::way(double value) const {
    const double end = value < nominal ? min : max;
    return end == nominal ? std::abs(value - nominal) > 0.0 : (value - nominal) / (end - nominal);
}

std::vector<Range> ranges(const Gyros& gyros, const Rows& rows) {
    const Description& description = gyros.description();
    std::vector<Range> found;
    for (std::size_t k = 0; k < description.parameters.size(); ++k) {
        const Parameter& p = description.parameters[k];
        if (has_values(p.draw)) continue;
        found.push_back(has_range(p.draw) ? Range{.parameter = k, .min = p.min, .max = p.max}
                                          : Range{.parameter = k, .min = p.mean, .max = p.mean});
    }
    widen_to_rows(found, gyros, rows);
    const config::Settings base = config::to_settings(base_config(description));
    for (Range& range : found) {
        const double middle = 0.5 * (range.min + range.max);
        const std::string& key = description.parameters[range.parameter].keys.front();
        range.nominal = std::clamp(number_in(base, key).value_or(middle), range.min, range.max);
    }
    return found;
}

std::optional<Yield> yield_within(const Gyros& gyros, const Rows& rows, const std::vector<Range>& ranges,
                                  const std::vector<double>& ways) {
    const Yield yield = yield_within(placed(gyros, rows, ranges), ways, gyros.description());
    return yield.gyros > 0 ? std::optional{yield} : std::nullopt;
}

Tolerances tolerances(const Gyros& gyros, const Rows& rows, double wanted_yield, std::int64_t least_gyros) {
    Tolerances found{.ranges = ranges(gyros, rows)};
    found.ways.assign(found.ranges.size(), 1.0);
    const std::vector<Placed> all = placed(gyros, rows, found.ranges);
    Count count = count_within(all, found.ways);
    while (count.gyros >= least_gyros && count.yield() < wanted_yield) {
        const std::size_t k = next(all, found.ways, least_gyros);
        if (k == found.ways.size()) break;
        found.ways[k] *= draw_in;
        count = count_within(all, found.ways);
    }
    if (count.gyros > 0) found.yield = yield_within(all, found.ways, gyros.description());
    found.is_reached = count.gyros >= least_gyros && count.yield() >= wanted_yield;
    return found;
}

}  // namespace zlg::sweep
