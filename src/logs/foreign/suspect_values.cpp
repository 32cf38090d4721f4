#include "suspect_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>
#include <zlg/logs/error.hpp>

namespace zlg::logs {

namespace {

// From one known value to the next.
struct Step {
    std::size_t from = 0, to = 0;
    double size = 0.0;

    [[nodiscard]] double rows() const { return static_cast<double>(to - from); }
};

std::vector<Step> steps_of(const std::vector<double>& values) {
    std::vector<Step> steps;
    std::size_t last = 0;
    for (std::size_t k = 1; k < values.size(); ++k) {
        if (std::isnan(values[k])) continue;
        if (!std::isnan(values[last])) steps.push_back({last, k, values[k] - values[last]});
        last = k;
    }
    return steps;
}

double usual_size(const std::vector<Step>& steps) {
    std::vector<double> sizes;
    for (const Step& step : steps) sizes.push_back(std::fabs(step.size));
    const auto middle = sizes.begin() + std::ssize(sizes) / 2;
    std::nth_element(sizes.begin(), middle, sizes.end());
    return *middle;
}

// A saw, whatever its height: nearly all steps go one way, +1 or -1. 0: they do not, as in what swings to and fro.
double way_of(const std::vector<Step>& steps) {
    constexpr std::ptrdiff_t enough = 12;
    const auto up = std::ranges::count_if(steps, [](const Step& step) { return step.size > 0.0; });
    const auto down = std::ranges::count_if(steps, [](const Step& step) { return step.size < 0.0; });
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
    const std::vector<Step> steps = steps_of(column.values);
    if (steps.size() < 3) return;
    const double usual = usual_size(steps), way = is_angle ? way_of(steps) : 0.0;
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const double value : column.values) {
        least = std::fmin(least, value);
        most = std::fmax(most, value);
    }
    constexpr double circle = 360.0 * 3600.0;
    const std::vector<double> ranges = unit.of_counts || !is_angle
                                           ? std::vector<double>{65536.0, 16777216.0, 4294967296.0}
                                           : std::vector<double>{circle / unit.arcsec, circle / 2.0 / unit.arcsec};
    for (const Step& step : steps) {
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
    }
}

void take_out_missing(const Mapping& mapping, TextTable& read) {
    const auto mark = mapping.real("missing");
    if (!mark) return;
    for (TextColumn& column : read.columns)
        std::ranges::replace(column.values, *mark, std::numeric_limits<double>::quiet_NaN());
}

void refuse_missing_marks(const std::string& path, const TextColumn& column) {
    constexpr std::array<double, 9> marks{999.0,   9999.0,  99999.0,      999999.0,    9999999.0,
                                          32767.0, 32768.0, 2147483647.0, 2147483648.0};
    for (const double sign : {-1.0, 1.0}) {
        for (const double size : marks) {
            const double mark = sign * size;
            const auto found = std::ranges::find(column.values, mark);
            if (found == column.values.end()) continue;
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
                            path, described(column), found - column.values.begin() + 1, mark, mark));
        }
    }
}

std::string stopped(const TextColumn& column) {
    constexpr std::size_t many_rows = 32, many_times = 10;
    std::size_t run = 1, longest = 1, before = 1;
    for (std::size_t k = 1; k < column.values.size(); ++k) {
        const bool goes_on = column.values[k] == column.values[k - 1];
        run = goes_on ? run + 1 : 1;
        if (!goes_on) before = longest;
        longest = std::max(longest, run);
    }
    if (run == column.values.size() || run < many_rows || run < many_times * before) return {};
    return fmt::format("{}: its last {} rows are all {}, and count as any other", described(column), run,
                       column.values.back());
}

}  // namespace zlg::logs
