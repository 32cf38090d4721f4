#include <zlg/sweep/tolerances.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace zlg::sweep {
namespace {

constexpr double draw_in = 0.9;

// The parameter to draw in next; ways.size(): none leaves enough gyros.
std::size_t next(const Placement& placement, const std::vector<double>& ways, const Yield& before,
                 std::int64_t fewest) {
    std::size_t best = ways.size();
    double best_gain = 0.0;
    for (std::size_t k = 0; k < ways.size(); ++k) {
        std::vector<double> tried = ways;
        tried[k] *= draw_in;
        const std::optional<Yield> after = placement.yield_within(tried);
        if (!after || after->gyros < fewest) continue;
        const auto lost = static_cast<double>(before.gyros - after->gyros);
        const double gain = (after->value - before.value) / (lost + 1.0);
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

std::vector<Range> ranges_of(const Gyros& gyros, const Rows& rows) {
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

}  // namespace

double Range::way(double value) const {
    const double end = value < nominal ? min : max;
    return end == nominal ? std::abs(value - nominal) > 0.0 : (value - nominal) / (end - nominal);
}

Placement::Placement(const Gyros& gyros, const Rows& rows) : ranges_{ranges_of(gyros, rows)} {
    for (const auto& [gyro, row] : rows) {
        const std::vector<Value> values = gyros.values(gyro);
        Placed one{.ways = {}, .passes = passes_all(gyros.description(), row)};
        for (const Range& range : ranges_) one.ways.push_back(range.way(std::get<double>(values[range.parameter])));
        all_.push_back(std::move(one));
    }
}

std::optional<Yield> Placement::yield_within(const std::vector<double>& ways) const {
    std::int64_t gyros = 0, passed = 0;
    for (const Placed& one : all_) {
        if (!std::ranges::equal(one.ways, ways, std::ranges::less_equal{})) continue;
        ++gyros;
        passed += one.passes ? 1 : 0;
    }
    return gyros > 0 ? std::optional{yield_of(passed, gyros)} : std::nullopt;
}

Tolerances tolerances(const Placement& placement, double wanted_yield, std::int64_t fewest) {
    Tolerances found{.ways = std::vector<double>(placement.ranges().size(), 1.0)};
    found.yield = placement.yield_within(found.ways);
    const auto is_enough = [&] { return found.yield && found.yield->gyros >= fewest; };
    while (is_enough() && found.yield->value < wanted_yield) {
        const std::size_t k = next(placement, found.ways, *found.yield, fewest);
        if (k == found.ways.size()) break;
        found.ways[k] *= draw_in;
        found.yield = placement.yield_within(found.ways);
    }
    found.is_reached = is_enough() && found.yield->value >= wanted_yield;
    return found;
}

}  // namespace zlg::sweep
