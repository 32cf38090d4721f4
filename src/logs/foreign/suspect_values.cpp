#include "suspect_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>
#include <zlg/logs/error.hpp>

namespace zlg::logs {

// A jump of a whole range, where the steps beside it are small, is a register or a circle that began anew.
void refuse_wraps(const ForeignLook& look, const TextColumn& column, const AngleUnit& unit) {
    const bool is_angle = look.mapping.text("holds") == "angle";
    // A rate or an increment is a register where all of it are whole numbers.
    const auto is_whole = [](double v) { return std::isnan(v) || v == std::floor(v); };
    if (!is_angle && !std::ranges::all_of(column.values, is_whole)) return;
    std::vector<double> steps;
    for (std::size_t k = 1; k < column.values.size(); ++k) {
        const double step = std::fabs(column.values[k] - column.values[k - 1]);
        if (!std::isnan(step)) steps.push_back(step);
    }
    if (steps.size() < 3) return;
    const auto middle = steps.begin() + std::ssize(steps) / 2;
    std::nth_element(steps.begin(), middle, steps.end());
    constexpr double circle = 360.0 * 3600.0;
    const std::vector<double> ranges = unit.of_counts || !is_angle
                                           ? std::vector<double>{65536.0, 16777216.0, 4294967296.0}
                                           : std::vector<double>{circle / unit.arcsec, circle / 2.0 / unit.arcsec};
    std::size_t last = 0;
    for (std::size_t k = 1; k < column.values.size(); ++k) {
        if (std::isnan(column.values[k])) continue;
        const double jump = std::fabs(column.values[k] - column.values[last]);
        const double slack = 5.0 * *middle * static_cast<double>(k - last);
        for (const double range : ranges)
            if (slack < range / 8.0 && std::fabs(jump - range) <= slack + 1e-3 * range)
                throw FormatError(fmt::format(
                    "{}, {}, row {}: it jumps from {} to {}, as one that begins anew after {:.9g} does; "
                    "allowed are numbers that go on",
                    look.table.path, described(column), k + 1, column.values[last], column.values[k], range));
        last = k;
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
