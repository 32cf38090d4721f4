#pragma once
// From values to places on the page.

#include <cmath>
#include <limits>

namespace zlg::report {

// The extent of the finite values it was given.
struct Extent {
    double lo = std::numeric_limits<double>::infinity();
    double hi = -std::numeric_limits<double>::infinity();

    void add(double value);
    [[nodiscard]] bool empty() const { return !(lo <= hi); }
};

// Where an axis is linear: the value itself, or its decimal logarithm. NaN for a value that the axis cannot show.
[[nodiscard]] double on_axis(double value, bool log);

// The limits of an axis that shows `data` (in axis units) with some air around it; never empty.
[[nodiscard]] Extent limits(Extent data, bool log);

struct Scale {
    bool log = false;
    Extent limits{0.0, 1.0};  // in axis units
    double at_lo = 0.0;       // places of the two limits
    double at_hi = 1.0;

    [[nodiscard]] bool shows(double value) const { return std::isfinite(on_axis(value, log)); }

    // Place of a point of the axis, held within the axis. `axis_value` is not NaN.
    [[nodiscard]] double at_axis(double axis_value) const;

    // Place of a value. A value that a log axis cannot show lies at its lower end.
    [[nodiscard]] double at(double value) const;
};

}  // namespace zlg::report
