#pragma once
// Which tolerances must be held for a wanted part of the gyros to pass: read from the gyros of one sweep over wider ranges.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <zlg/sweep/results.hpp>
#include <zlg/sweep/statistics.hpp>

namespace zlg::sweep {

// The range of a parameter and its middle: the value of the base where that lies within, else the nearer end.
struct Range {
    std::size_t parameter = 0;  // its number in the description
    double nominal = 0.0;
    double min = 0.0;
    double max = 0.0;

    // How far a value is from the nominal one, as part of the way to the end of the range on its side: 0..1.
    [[nodiscard]] double way(double value) const;
    // The value at that part of the way, below and above.
    [[nodiscard]] double below(double way) const { return nominal - way * (nominal - min); }
    [[nodiscard]] double above(double way) const { return nominal + way * (max - nominal); }
};

// Of the parameters that are drawn from an interval; of a normal law, from the least to the greatest value of the rows. So every
// gyro lies within the full ranges.
[[nodiscard]] std::vector<Range> ranges(const Gyros& gyros, const Rows& rows);

// The gyros of which every parameter lies within its part of the way: how many there are, and how many of them pass.
[[nodiscard]] std::optional<Yield> yield_within(const Gyros& gyros, const Rows& rows, const std::vector<Range>& ranges,
                                                const std::vector<double>& ways);

struct Tolerances {
    std::vector<Range> ranges;
    std::vector<double> ways;    // to be held, of each range; 1: all of it
    std::optional<Yield> yield;  // of the gyros within them
    bool is_reached = false;     // that yield is at least the wanted one
};

// From the full ranges the tolerance of one parameter after the other is drawn in by a tenth, each time that one by which the
// yield grows most for each gyro that is lost, until it is reached or fewer than `least_gyros` are left. Chosen by
// the sample that it is read from, the yield is a little too good: a sweep over these tolerances verifies it.
[[nodiscard]] Tolerances tolerances(const Gyros& gyros, const Rows& rows, double wanted_yield,
                                    std::int64_t least_gyros = 30);

}  // namespace zlg::sweep
