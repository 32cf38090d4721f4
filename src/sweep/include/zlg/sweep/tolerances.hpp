#pragma once
// Which tolerances must be held for a wanted part of the gyros to pass: read from the gyros of one sweep over wider
// ranges.

#include <cstddef>
#include <optional>
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

// The gyros of a sweep by how far each of their parameters is from its nominal value. The ranges are those of the
// parameters that are drawn from an interval; of a normal law, from the least to the greatest value of the rows. So
// every gyro lies within the full ranges.
class Placement {
public:
    Placement(const Gyros& gyros, const Rows& rows);

    [[nodiscard]] const std::vector<Range>& ranges() const { return ranges_; }

    // Of the gyros of which every parameter lies within its part of the way, one for each range; nothing where there
    // are none.
    [[nodiscard]] std::optional<Yield> yield_within(const std::vector<double>& ways) const;

private:
    struct Placed {
        std::vector<double> ways;
        bool passes = false;
    };

    std::vector<Range> ranges_;
    std::vector<Placed> all_;
};

struct Tolerances {
    std::vector<double> ways;    // to be held, of each range; 1: all of it
    std::optional<Yield> yield;  // of the gyros within them
    bool is_reached = false;     // that yield is at least the wanted one
};

// From the full ranges the tolerance of one parameter after the other is drawn in by a tenth, each time that one by
// which the yield grows most for each gyro that is lost, until it is reached or what is left are fewer than
// `fewest` gyros. Chosen by the sample that it is read from, the yield is a little too good: a sweep
// over these tolerances verifies it.
[[nodiscard]] Tolerances tolerances(const Placement& placement, double wanted_yield, std::int64_t fewest = 30);

}  // namespace zlg::sweep
